import {element} from '../dom.js';

// Each key with what it does.
export function timeKeys({player, steps}) {
  return [
    {keys: [' ', 'k'], shown: 'space', text: 'play or pause', act: () => player.toggle()},
    {
      keys: ['ArrowRight'],
      shown: '→',
      text: 'one second forward; with shift, one sample',
      act: (e) => (e.shiftKey ? player.step(1) : player.seek(player.time + 1))
    },
    {
      keys: ['ArrowLeft'],
      shown: '←',
      text: 'one second back; with shift, one sample',
      act: (e) => (e.shiftKey ? player.step(-1) : player.seek(player.time - 1))
    },
    {keys: ['.'], shown: '.', text: 'one sample forward', act: () => player.step(1)},
    {keys: [','], shown: ',', text: 'one sample back', act: () => player.step(-1)},
    {keys: ['ArrowDown', 'PageDown'], shown: '↓', text: 'next step', act: () => steps.go(1)},
    {
      keys: ['ArrowUp', 'PageUp'],
      shown: '↑',
      text: 'beginning of this step, or previous step',
      act: () => steps.go(-1)
    },
    {keys: ['Home'], shown: 'home', text: 'to the start', act: () => player.seek(player.start)},
    {keys: ['End'], shown: 'end', text: 'to the end', act: () => player.seek(player.end)},
    {keys: ['+', '='], shown: '+', text: 'faster', act: () => player.faster(1)},
    {keys: ['-'], shown: '−', text: 'slower', act: () => player.faster(-1)},
  ];
}

export function cameraKeys({viewport, options, help}) {
  const names = viewport.cameraNames();
  return [
    ...names.map((name, i) => ({
                   keys: [String(i + 1)],
                   shown: String(i + 1),
                   text: `camera ${name}`,
                   act: () => viewport.choose(name)
                 })),
    {
      keys: ['r'],
      shown: 'r',
      text: 'reset the camera',
      act: () => viewport.choose(viewport.chosen)
    },
    {keys: ['b'], shown: 'b', text: 'believed poses', act: () => options.toggle('showsBelieved')},
    {keys: ['e'], shown: 'e', text: 'predicted errors', act: () => options.toggle('showsSets')},
    ...(viewport.picture.contacts.exist ? [{
      keys: ['c'],
      shown: 'c',
      text: 'contacts and their forces',
      act: () => options.toggle('showsContacts')
    }] :
                                          []),
    ...(viewport.beside ? [{
      keys: ['p'],
      shown: 'p',
      text: viewport.beside.name,
      act: () => options.toggle('showsBeside')
    }] :
                          []),
    {keys: ['?', 'h'], shown: '?', text: 'this list', act: help},
  ];
}

// Fields that take keys themselves.
const takesKeys = (target) => target.matches('select, input, textarea');
const isPressed = (target, key) => key === ' ' && target.matches('button, summary');

export function listenToKeys(keys) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (takesKeys(event.target) || isPressed(event.target, event.key)) return;
    const found = keys.find((entry) => entry.keys.includes(event.key));
    if (!found) return;
    event.preventDefault();
    found.act(event);
  });
  // A button that was clicked with the mouse would take the space bar, which people press to play.
  document.addEventListener('click', (event) => {
    if (event.detail > 0) event.target.closest('button, summary')?.blur();
  });
}

// The list of keys, and how the mouse turns the picture. A click closes the list.
export function helpOf(keys) {
  const mouse = [
    ['drag', 'turn the picture'], ['right drag, shift drag', 'move the picture'], ['wheel', 'zoom'],
    ['press or drag on the time line', 'go to this time']
  ];
  const rows = [...mouse, ...keys.map(({shown, text}) => [shown, text])];
  return element(
      'dialog', {class: 'help', onclick: (event) => event.currentTarget.close()},
      element('h2', {}, 'Mouse and keys'),
      element(
          'table', {},
          ...rows.map(
              ([key, text]) =>
                  element('tr', {}, element('th', {}, key), element('td', {}, text)))),
      element('button', {class: 'where'}, 'Close'));
}
