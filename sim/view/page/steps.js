import {certificateOf} from './certificate.js';
import {element} from './dom.js';
import {standingOf, summaryOf, uncoveredOf, verdictOf} from './standing.js';
import {countText} from './units.js';

// The steps as a list, and the certificate of the one that is shown. A click goes to the step.
export class Steps {
  constructor(data, player) {
    Object.assign(this, {data, player});
    this.buttons = data.steps.map((step) => this.buttonOf(step));
    this.list = element('ol', {class: 'steps'}, ...this.buttons.map((b) => element('li', {}, b)));
    this.detail = element('div', {class: 'detail'});
    this.root = element(
        'aside', {'aria-label': 'Steps and certificates'}, this.headOf(), this.list, this.detail);
    player.onChange(() => this.select(this.at(player.time)));
    this.select(0);
  }

  headOf() {
    const {title, source, outcome} = this.data;
    const failed = outcome.name !== 'succeeded';
    return element(
        'header', {}, element('h1', {}, title), element('p', {class: 'source'}, source),
        element(
            'p', {class: failed ? 'outcome bad' : 'outcome'}, `Execution ${outcome.name}`,
            outcome.reason ? `: ${outcome.reason}` : ''),
        element('p', {class: 'summary'}, summaryOf(this.data)), ...this.notCovered());
  }

  notCovered() {
    const names = this.data.notCovered;
    if (names.length === 0) return [];
    return [element(
        'details', {class: 'more'},
        element(
            'summary', {}, `${countText(names.length, 'danger')} not covered by any precondition`),
        element('ul', {}, ...names.map((name) => element('li', {}, name))))];
  }

  buttonOf(step) {
    const {mark, color, text, isOpen} = standingOf(step, this.data.colors);
    const verdict = verdictOf(step);
    const reached = step.from !== undefined;
    const uncovered = uncoveredOf(step, this.data).length;
    const notes = [
      text, uncovered > 0 ? `${uncovered} not covered` : '', verdict, reached ? '' : 'not reached'
    ].filter(Boolean).join(', ');
    return element(
        'button', {
          class: isOpen ? 'open' : '',
          style: `--standing: ${color}`,
          onclick: () => this.goTo(step)
        },
        element('span', {class: 'number'}, String(step.number)),
        element('span', {class: 'action'}, step.action),
        element('span', {class: 'standing'}, element('span', {class: 'mark'}, mark), ` ${notes}`));
  }

  // The step in which a time lies; what follows the last step belongs to it.
  at(time) {
    const index = this.data.steps.findIndex((step) => step.from !== undefined && time < step.to);
    if (index >= 0) return index;
    return this.data.steps.reduce((last, step, i) => (step.from !== undefined ? i : last), 0);
  }

  goTo(step) {
    if (step.from !== undefined) this.player.seek(step.from);
    this.select(step.number - 1);
  }
  // Goes to the step before or after. Within the first second of a step, "before" is the previous
  // one.
  go(count) {
    const index = this.at(this.player.time);
    const early = this.player.time - this.data.steps[index].from < 1;
    const wanted = count < 0 && !early ? index : index + count;
    if (wanted >= this.data.steps.length)
      this.player.seek(this.player.end);
    else
      this.goTo(this.data.steps[Math.max(0, wanted)]);
  }

  select(index) {
    if (index === this.selected) return;
    this.selected = index;
    this.buttons.forEach(
        (button, i) => button.setAttribute('aria-current', i === index ? 'step' : 'false'));
    const button = this.buttons[index];
    const [top, bottom] = [button.offsetTop - this.list.offsetTop, this.list.clientHeight];
    if (top < this.list.scrollTop || top + button.offsetHeight > this.list.scrollTop + bottom)
      this.list.scrollTop = top;
    this.detail.replaceChildren(certificateOf(this.data.steps[index], this.data));
    this.detail.scrollTop = 0;
  }
}
