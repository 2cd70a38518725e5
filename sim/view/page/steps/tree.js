import {element} from '../dom.js';

// The lines of a plan tree. Lines on the way of the execution lead to their steps, and all other
// lines are pale. Returns the list and, for each step, its button.
export function treeOf(data, noteOf, goTo) {
  const buttons = [];
  const items = data.tree.map((line) => {
    const item = itemOf(line, data, noteOf, goTo);
    for (const step of line.steps) buttons[step] = item;
    return element(
        'li', {class: line.gone ? 'gone' : 'left', style: `--depth: ${line.depth}`}, item);
  });
  return {list: element('ol', {class: 'steps tree'}, ...items), buttons};
}

function itemOf(line, data, noteOf, goTo) {
  if (line.steps.length === 0) {
    return element('span', {class: line.action ? 'action' : 'outcome'}, line.text);
  }
  const [first] = line.steps;
  const times = line.steps.length > 1 ? ` (${line.steps.length} times)` : '';
  return element(
      'button', {onclick: () => goTo(data.steps[first])},
      element('span', {class: 'number'}, String(data.steps[first].number)),
      element('span', {class: 'action'}, line.text + times), noteOf(data.steps[first]));
}
