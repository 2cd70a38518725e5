import {element} from '../dom.js';

import {bodiesNamedIn} from './names.js';

// Why there is no plan. A click on a sentence marks the bodies that it names.
export class WhyNot {
  constructor(data, viewport) {
    Object.assign(this, {data, viewport, chosen: null});
    const {title, source, outcome, whyNot} = data;
    this.root = element(
        'aside', {'aria-label': 'Reasons'},
        element(
            'header', {}, element('h1', {}, title), element('p', {class: 'source'}, source),
            element('p', {class: 'outcome bad'}, `${outcome.name}.`)),
        element('div', {class: 'detail'}, ...whyNot.flatMap((reasons) => this.listOf(reasons))));
  }

  listOf({title, sentences}) {
    return [
      element('h3', {}, title),
      element('ul', {class: 'reasons'}, ...sentences.map((text) => this.itemOf(text)))
    ];
  }

  itemOf(text) {
    const bodies = bodiesNamedIn(text, this.data);
    if (bodies.length === 0) return element('li', {}, text);
    const button = element(
        'button', {'aria-pressed': 'false', onclick: () => this.choose(button, bodies)}, text);
    return element('li', {}, button);
  }

  choose(button, bodies) {
    if (this.chosen) this.chosen.setAttribute('aria-pressed', 'false');
    this.chosen = this.chosen === button ? null : button;
    if (this.chosen) button.setAttribute('aria-pressed', 'true');
    this.viewport.mark(this.chosen ? bodies : []);
  }
}
