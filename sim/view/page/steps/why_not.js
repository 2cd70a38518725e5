import {element} from '../dom.js';
import {quantityText} from '../units.js';

import {bodiesNamedIn} from './names.js';

// The reasons why there is no plan. A click on a reason marks the bodies that it is about. Bodies
// at other poses than the present ones are drawn as ghosts.
export class WhyNot {
  constructor(data, viewport) {
    Object.assign(this, {data, viewport, chosen: null});
    const {title, source, outcome, whyNot} = data;
    this.root = element(
        'aside', {'aria-label': 'Reasons'},
        element(
            'header', {}, element('h1', {}, title), element('p', {class: 'source'}, source),
            element('p', {class: 'outcome bad'}, `${outcome.name}.`)),
        element('div', {class: 'detail'}, ...whyNot.flatMap((kind) => this.listOf(kind))));
    this.showFirst();
  }

  listOf({title, reasons}) {
    return [
      element('h3', {}, title),
      element('ul', {class: 'reasons'}, ...reasons.map((reason) => this.itemOf(reason)))
    ];
  }

  // A reason without a situation is about the bodies that its sentence names.
  itemOf({text, marked, ghosts, excess}) {
    const names = marked || bodiesNamedIn(text, this.data);
    const drawn = ghosts || [];
    if (names.length === 0 && drawn.length === 0) return element('li', {}, text);
    const button = element(
        'button', {'aria-pressed': 'false', onclick: () => this.choose(button, names, drawn)}, text,
        excess ? element('small', {}, excessText(excess)) : null);
    return element('li', {}, button);
  }

  choose(button, names, ghosts) {
    if (this.chosen) this.chosen.setAttribute('aria-pressed', 'false');
    this.chosen = this.chosen === button ? null : button;
    if (this.chosen) button.setAttribute('aria-pressed', 'true');
    this.viewport.mark(this.chosen ? names : [], {ghosts: this.chosen ? ghosts : []});
  }

  // Shows the first reason when the page is opened.
  showFirst() {
    const first = this.root.querySelector('.reasons button');
    if (first) first.click();
  }
}

function excessText({unit, value, limit}) {
  const [is, most, more] =
      [value, limit, value - limit].map((quantity) => quantityText(quantity, unit));
  return `${is}; at most ${most} is allowed; ${more} too much`;
}
