import {Group} from 'three';

import {edgesOf} from './stage.js';

export const BELIEVED = '#7b3fa8';

// Outlines of each part at its believed pose, and at the extremes of its predicted error set about
// this pose.
export class Outlines {
  constructor(data, recording) {
    this.recording = recording;
    this.sets = data.errorSets;
    this.lines = new Map();  // of the sets that have been shown
    this.root = new Group();
    this.parts = data.parts.map((part) => {
      const frame = new Group();
      const ghost = edgesOf(part, BELIEVED, 1);
      const extremes = new Group();
      frame.add(ghost, extremes);
      this.root.add(frame);
      return {part, frame, ghost, extremes, shown: null};
    });
    this.color = data.colors.predicted;
    this.showsBelieved = true;
    this.showsSets = true;
  }

  setAt(part, time) {
    return this.sets.find((set) => set.part === part && set.from <= time && time < set.to) || null;
  }

  show(moment, time) {
    this.parts.forEach((outline, i) => {
      this.recording.place(this.recording.believed[i], moment, outline.frame);
      outline.ghost.visible = this.showsBelieved;
      outline.extremes.visible = this.showsSets;
      const set = this.setAt(i, time);
      if (set !== outline.shown) this.replace(outline, set);
    });
  }

  replace(outline, set) {
    outline.shown = set;
    outline.extremes.remove(...outline.extremes.children);
    (set && set.fixed ? this.root : outline.frame).add(outline.extremes);
    if (set) outline.extremes.add(this.linesOf(set, outline.part));
  }

  linesOf(set, part) {
    if (!this.lines.has(set)) this.lines.set(set, edgesOf(part, this.color, 0.85, set.extremes));
    return this.lines.get(set);
  }
}
