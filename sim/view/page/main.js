import {element} from './dom.js';
import {Viewport} from './picture/viewport.js';
import {Steps} from './steps/steps.js';
import {WhyNot} from './steps/why_not.js';
import style from './style.css';
import {Controls, ViewOptions} from './time/controls.js';
import {cameraKeys, helpOf, listenToKeys, timeKeys} from './time/keys.js';
import {Player} from './time/player.js';
import {Readings} from './time/readings.js';
import {Recording} from './time/recording.js';
import {Timeline} from './time/timeline.js';

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

// A scene for which there is no plan stands still.
function showStill(data) {
  const recording = new Recording(data);
  const viewport = new Viewport(data, recording);
  const help = () => dialog.showModal();
  const options = new ViewOptions(viewport, data, help);
  const keys = cameraKeys({viewport, options, help});
  const dialog = helpOf(keys);
  document.body.append(
      element('main', {}, element('div', {class: 'picture'}, viewport.root, options.root)),
      new WhyNot(data, viewport).root, dialog);
  listenToKeys(keys);
  return {player: new Player(recording), viewport};
}

function showExecution(data) {
  const recording = new Recording(data);
  const player = new Player(recording);
  const viewport = new Viewport(data, recording);
  const steps = new Steps(data, player, viewport);
  const help = () => dialog.showModal();
  const options = new ViewOptions(viewport, data, help);
  const keys = [...timeKeys({player, steps}), ...cameraKeys({viewport, options, help})];
  const dialog = helpOf(keys);
  const readings = new Readings(data, recording, player, viewport.picture.contacts);
  document.body.append(
      element(
          'main', {},
          element('div', {class: 'picture'}, viewport.root, options.root, readings.root),
          element(
              'div', {class: 'below'}, new Controls(player, steps).root,
              new Timeline(data, recording, player).root)),
      steps.root, dialog);
  player.onChange(() => viewport.show(player.time));
  listenToKeys(keys);
  return {player, viewport};
}

function show(data) {
  document.head.append(element('style', {}, style));
  window.assayView = data.whyNot.length > 0 ? showStill(data) : showExecution(data);
  animate(window.assayView.player, window.assayView.viewport);
}

show(JSON.parse(document.getElementById('data').textContent));
