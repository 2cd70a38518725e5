import {Controls, ViewOptions} from './controls.js';
import {element} from './dom.js';
import {helpOf, keysOf, listenToKeys} from './keys.js';
import {Player} from './player.js';
import {Readings} from './readings.js';
import {Recording} from './recording.js';
import {Steps} from './steps.js';
import style from './style.css';
import {Timeline} from './timeline.js';
import {Viewport} from './viewport.js';

// Draws before each repaint of the screen while something changes.
function animate(player, viewport) {
  let last = performance.now();
  const frame = (now) => {
    player.pass(Math.min(0.25, (now - last) / 1000));
    last = now;
    viewport.draw();
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

function show(data) {
  const recording = new Recording(data);
  const player = new Player(recording);
  const viewport = new Viewport(data, recording);
  const steps = new Steps(data, player);
  const help = () => dialog.showModal();
  const options = new ViewOptions(viewport, data, help);
  const keys = keysOf({player, steps, viewport, options, help});
  const dialog = helpOf(keys);
  const readings = new Readings(data, recording, player);
  document.head.append(element('style', {}, style));
  document.body.append(
      element(
          'main', {},
          element('div', {class: 'picture'}, viewport.surface, options.root, readings.root),
          element(
              'div', {class: 'below'}, new Controls(player, steps).root,
              new Timeline(data, recording, player).root)),
      steps.root, dialog);
  player.onChange(() => viewport.show(player.time));
  listenToKeys(keys);
  animate(player, viewport);
  window.assayView = {player, viewport};
}

show(JSON.parse(document.getElementById('data').textContent));
