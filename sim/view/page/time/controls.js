import {drawing, element} from '../dom.js';
import {TOUCHING} from '../picture/contact_marks.js';
import {BELIEVED} from '../picture/outlines.js';

import {SPEEDS} from './player.js';

// Drawings of 16 by 16 pixels, since fonts lack these signs.
const ICONS = {
  play: 'M4 2l10 6-10 6z',
  pause: 'M3 2h4v12H3zM9 2h4v12H9z',
  back: 'M2 2h2v12H2zM14 2v12L5 8z',
  on: 'M12 2h2v12h-2zM2 2v12l9-6z',
};
const icon = (name) => drawing(
    'svg', {width: 14, height: 14, viewBox: '0 0 16 16', 'aria-hidden': 'true'},
    drawing('path', {d: ICONS[name]}));

// Play, speed and time, below the picture.
export class Controls {
  constructor(player, steps) {
    const button = (label, text, onclick) =>
        element('button', {'aria-label': label, title: label, onclick}, text);
    this.play = button('Play (space)', icon('play'), () => player.toggle());
    this.speed = element(
        'select', {
          'aria-label': 'Speed',
          title: 'Speed (+ and −)',
          onchange: () => player.setSpeed(Number(this.speed.value))
        },
        ...SPEEDS.map((speed) => element('option', {value: speed}, `${speed}×`)));
    this.time = element('output', {class: 'clock'});
    this.root = element(
        'div', {class: 'controls'}, button('Previous step (↑)', icon('back'), () => steps.go(-1)),
        this.play, button('Next step (↓)', icon('on'), () => steps.go(1)), this.time, this.speed);
    player.onGlance(() => this.show(player));
    this.show(player);
  }

  show(player) {
    if (player.playing !== this.playing) this.showPlaying(player.playing);
    this.speed.value = String(player.speed);
    this.time.textContent = `${player.time.toFixed(2)} / ${player.end.toFixed(1)} s`;
  }

  showPlaying(playing) {
    this.playing = playing;
    const label = playing ? 'Pause (space)' : 'Play (space)';
    this.play.setAttribute('aria-label', label);
    this.play.title = label;
    this.play.replaceChildren(icon(playing ? 'pause' : 'play'));
  }
}

// Cameras and what is shown, over the picture.
export class ViewOptions {
  constructor(viewport, data, help) {
    this.viewport = viewport;
    this.cameras = viewport.cameraNames().map(
        (name) => element('button', {onclick: () => viewport.choose(name)}, name));
    this.toggles = {
      showsBelieved: this.toggleOf('showsBelieved', 'believed poses', BELIEVED, 'b'),
      showsSets: this.toggleOf('showsSets', 'predicted errors', data.colors.predicted, 'e'),
    };
    if (viewport.picture.contacts.exist)
      this.toggles.showsContacts = this.toggleOf('showsContacts', 'contacts', TOUCHING, 'c');
    if (data.beside)
      this.toggles.showsBeside = this.toggleOf('showsBeside', 'beside', '#52606f', 'p');
    this.root = element(
        'div', {class: 'options'},
        element('div', {class: 'group', role: 'group', 'aria-label': 'Camera'}, ...this.cameras),
        element(
            'div', {class: 'group', role: 'group', 'aria-label': 'Shown'},
            ...Object.values(this.toggles)),
        element(
            'div', {class: 'group'}, element('button', {onclick: help, title: 'Keys (?)'}, '?')));
    viewport.onChoice((name) => this.mark(name));
    this.mark(viewport.chosen);
  }

  toggleOf(kind, text, color, key) {
    return element(
        'button', {
          'aria-pressed': 'true',
          title:
              `Show or hide ${kind === 'showsBeside' ? this.viewport.beside.name : text} (${key})`,
          style: `--line: ${color}`,
          class: 'toggle',
          onclick: () => this.toggle(kind)
        },
        text);
  }
  toggle(kind) {
    this.toggles[kind].setAttribute('aria-pressed', String(this.viewport.toggle(kind)));
  }
  mark(name) {
    this.viewport.cameraNames().forEach(
        (other, i) => this.cameras[i].setAttribute('aria-pressed', String(other === name)));
  }
}
