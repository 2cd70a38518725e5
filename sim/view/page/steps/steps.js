import {element} from '../dom.js';
import {WorkView} from '../picture/work_view.js';
import {countText} from '../units.js';

import {certificateOf} from './certificate.js';
import {headOf} from './head.js';
import {standingOf, uncoveredOf, VERDICT_MARKS, verdictOf, verdictText} from './standing.js';
import {treeOf} from './tree.js';

// The steps as a list or a tree, and the certificate of the step that is shown. A click on a step
// goes to its beginning.
export class Steps {
  constructor(data, player, viewport) {
    Object.assign(this, {data, player, viewport});
    const {list, buttons} = data.tree ?
        treeOf(data, (step) => this.noteOf(step), (step) => this.goTo(step)) :
        this.listOf();
    Object.assign(this, {list, buttons});
    this.detail = element('div', {class: 'detail'});
    this.root =
        element(
            'aside', {'aria-label': 'Steps and certificates'},
            headOf(data, (step) => this.goTo(step)), list, this.detail);
    player.onChange(() => {
      if (player.time !== this.placeTime) this.leavePlace();
      this.select(this.at(player.time));
    });
    if (data.steps.length > 0) this.select(0);
  }

  listOf() {
    const buttons = this.data.steps.map(
        (step) => element(
            'button', {onclick: () => this.goTo(step)},
            element('span', {class: 'number'}, String(step.number)),
            element('span', {class: 'action'}, step.action), this.noteOf(step)));
    const items = buttons.map((button) => element('li', {}, button));
    return {buttons, list: element('ol', {class: 'steps'}, ...items)};
  }

  // Returns whether the step's certificate is proved, as a text with a mark. Actions that belong to
  // no plan have no certificate. If this execution violates the certificate, the mark says so.
  noteOf(step) {
    if (!step.planned) return null;
    const {text, isOpen, ...proved} = standingOf(step, this.data.colors);
    const verdict = verdictOf(step);
    const {mark, color} = verdict === 'violated' ?
        {mark: VERDICT_MARKS.violated, color: this.data.colors.violated} :
        proved;
    const uncovered = uncoveredOf(step, this.data).length;
    const notes = [
      text, uncovered > 0 ? `${countText(uncovered, 'effect')} not covered` : '',
      verdict && verdictText(verdict), step.from === undefined ? 'not reached' : ''
    ].filter(Boolean).join(', ');
    return element(
        'span', {class: isOpen ? 'standing open' : 'standing', style: `--standing: ${color}`},
        element('span', {class: 'mark'}, mark), ` ${notes}`);
  }

  // Returns the index of the step in which a time lies. A step without duration has its one time.
  // Times after the last step belong to the last step.
  at(time) {
    const index = this.data.steps.findIndex(
        ({from, to}) => from !== undefined && (time < to || (from === to && time <= to)));
    if (index >= 0) return index;
    return this.data.steps.reduce((last, step, i) => (step.from !== undefined ? i : last), 0);
  }

  goTo(step) {
    if (step.from !== undefined) this.player.seek(step.from);
    this.select(step.number - 1);
  }
  // Goes to the beginning of the next step (count 1), or of this step (count -1). Within the first
  // second of a step, it goes back to the previous step.
  go(count) {
    if (this.data.steps.length === 0) return;
    const index = this.selected;
    const early = this.player.time - this.data.steps[index].from < 1;
    const wanted = count < 0 && !early ? index : index + count;
    if (wanted >= this.data.steps.length)
      this.player.seek(this.player.end);
    else
      this.goTo(this.data.steps[Math.max(0, wanted)]);
  }

  // Goes to the time of a place, or to the time when the step acts. Marks bodies there, draws ghosts
  // or lines, and turns the camera to them.
  showWhere(step, {time = step.acts, marked, ghosts, lines}) {
    this.player.playing = false;
    // A step that is verified acts at its very end, where the next one begins.
    const camera = this.cameraBefore || this.viewport.chosen;
    if (time !== undefined) this.player.seek(Math.min(time, step.to - 1e-3));
    this.viewport.choose(WorkView.NAME);
    this.viewport.mark(marked, {ghosts, lines});
    this.cameraBefore = camera;
    this.placeTime = this.player.time;
  }

  // Takes the marks out of the picture, and goes back to the camera that was chosen before, unless
  // people have chosen another one since.
  leavePlace() {
    if (this.placeTime === undefined) return;
    const camera = this.cameraBefore;
    this.placeTime = undefined;
    this.cameraBefore = undefined;
    this.viewport.mark([]);
    if (this.viewport.chosen === WorkView.NAME) this.viewport.choose(camera);
  }

  select(index) {
    if (index === this.selected || this.data.steps.length === 0) return;
    this.selected = index;
    this.leavePlace();
    const current = this.buttons[index];
    for (const button of this.buttons)
      button.setAttribute('aria-current', button === current ? 'step' : 'false');
    this.scrollTo(current);
    const step = this.data.steps[index];
    this.detail.replaceChildren(
        certificateOf(step, this.data, (where) => this.showWhere(step, where)));
    this.detail.scrollTop = 0;
  }

  scrollTo(button) {
    const [top, bottom] = [button.offsetTop - this.list.offsetTop, this.list.clientHeight];
    if (top < this.list.scrollTop || top + button.offsetHeight > this.list.scrollTop + bottom)
      this.list.scrollTop = top;
  }
}
