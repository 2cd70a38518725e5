import {element} from '../dom.js';
import {countText} from '../units.js';

import {standingOf, summaryOf} from './standing.js';

// The head of a page: the title, what was viewed, the outcome, and a summary of the certificates.
// Buttons call `goTo` with a step that is not proved.
export function headOf(data, goTo) {
  const {title, source, outcome} = data;
  const isGood = outcome.name === 'succeeded' || outcome.name === 'reached';
  return element(
      'header', {}, element('h1', {}, title), element('p', {class: 'source'}, source),
      element(
          'p', {class: isGood ? 'outcome' : 'outcome bad'}, outcomeText(outcome.name),
          outcome.reason ? `: ${outcome.reason}` : ''),
      ...violatedClaims(data), element('p', {class: 'summary'}, summaryOf(data)),
      ...unprovedSteps(data, goTo), ...notCovered(data));
}

function unprovedSteps(data, goTo) {
  return data.steps.filter((step) => step.planned && standingOf(step, data.colors).isOpen)
      .map(
          (step) => element(
              'button', {class: 'where', onclick: () => goTo(step)}, `Go to step ${step.number}`));
}

function outcomeText(name) {
  if (name === 'reached') return 'The goal was reached';
  return name === 'succeeded' ? 'Execution succeeded' : `Execution: ${name.replace('-', ' ')}`;
}

// What makes an execution a counterexample, even if the execution succeeded.
function violatedClaims(data) {
  const texts = data.steps.flatMap((step) => {
    const violated = step.verdicts.filter((claim) => claim.verdict === 'violated');
    const names = [...new Set(violated.map((claim) => claim.name))];
    return names.length > 0 ? [`step ${step.number} (${names.join(', ')})`] : [];
  });
  if (texts.length === 0) return [];
  return [element('p', {class: 'outcome bad'}, `Violated claims: ${texts.join('; ')}`)];
}

function notCovered(data) {
  const names = data.notCovered;
  if (names.length === 0) return [];
  return [element(
      'details', {class: 'more'},
      element(
          'summary', {}, `${countText(names.length, 'effect')} not covered by any precondition`),
      element('ul', {}, ...names.map((name) => element('li', {}, name))))];
}
