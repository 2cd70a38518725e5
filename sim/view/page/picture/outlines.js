import {Group} from 'three';

import {edgesOf, setPose} from './stage.js';

export const BELIEVED = '#7b3fa8';

// What is not real: each part where it is believed to be, and at the extremes of its predicted
// error set about that pose.
export class Outlines {
  constructor(data, recording) {
    this.recording = recording;
    this.sets = data.errorSets;
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
    for (const pose of set ? set.extremes : []) {
      const extreme = edgesOf(outline.part, this.color, 0.85);
      setPose(extreme, pose);
      outline.extremes.add(extreme);
    }
  }
}
