import {element} from '../dom.js';
import {countText, quantityText, rangeText} from '../units.js';

import {marginChart} from './margin_chart.js';
import {colorOf, MARKS, standingOf, uncoveredOf, VERDICT_MARKS, VERDICTS} from './standing.js';

// The certificate of one step: what was claimed, how far it is from its limit, and what costs most.
// `showWhere` is called with a sentence about what is not proved, to show it in the picture.
export function certificateOf(step, data, showWhere) {
  const standing = standingOf(step, data.colors);
  return element(
      'section', {class: 'certificate', 'aria-label': `Certificate of step ${step.number}`},
      element('h2', {}, `Step ${step.number}: ${step.action}`), ...leadsOf(step, standing),
      ...factsOf(step, data), ...uncoveredTexts(step, data),
      ...step.preconditions.map(
          (group, i) => preconditionOf(group, data.colors, i === 0, showWhere)),
      ...notNeededOf(step), ...doneOf(step), ...observedOf(step, data.colors));
}

function leadsOf(step, standing) {
  if (!step.planned) return step.facts ? [] : [element('p', {}, 'The action has no certificate.')];
  return [element('p', {class: 'lead'}, leadOf(step, standing))];
}

// What is known of an action that is no step of a plan, with its drawing.
function factsOf(step, data) {
  if (!step.facts) return [];
  const rows = step.facts.map(
      ([name, value]) =>
          element('tr', {}, element('th', {scope: 'row'}, name), element('td', {}, value)));
  const drawing = element('div', {class: 'drawing'});
  if (step.drawing !== undefined) drawing.innerHTML = data.drawings[step.drawing];
  return [element('table', {class: 'facts'}, ...rows), drawing];
}

function leadOf(step, standing) {
  if (!step.certified)
    return 'The plan was made without regard to uncertainty: nothing is certified.';
  const open = step.preconditions.filter((group) => group.standing === 'open');
  if (open.length > 0) {
    const worst = open[0];
    return `Not proved: ${worst.condition}. It is short by ${
        quantityText(-worst.margin, worst.unit)}.`;
  }
  if (step.preconditions.length === 0)
    return 'The step has no uncertainty-reduction preconditions.';
  const tightest = step.preconditions.find((group) => group.standing === 'proved');
  if (!tightest) return `Certificate: ${standing.text}.`;
  return `${standing.text}. The tightest, ${tightest.condition}, has ` +
      `${quantityText(tightest.margin, tightest.unit)} to spare.`;
}

function uncoveredTexts(step, data) {
  return uncoveredOf(step, data)
      .map(
          (sentence) =>
              element('p', {class: 'uncovered'}, `Not covered by any precondition: ${sentence}.`));
}

// A kind of precondition: one line, which opens to the whole proof.
function preconditionOf(group, colors, isFirst, showWhere) {
  const color = colorOf(group.standing, colors);
  const margin = group.standing === 'open' ?
      element('b', {}, `${quantityText(-group.margin, group.unit)} short`) :
      element('span', {}, quantityText(group.margin, group.unit));
  return element(
      'details', {
        class: `claim ${group.standing}`,
        open: isFirst || group.standing === 'open',
        style: `--standing: ${color}`
      },
      element(
          'summary', {},
          element('span', {class: 'mark', title: group.standing}, MARKS[group.standing]),
          element(
              'span', {class: 'name'}, group.condition,
              element('small', {}, group.count > 1 ? ` × ${group.count}` : '')),
          marginChart(group, color), element('span', {class: 'value'}, margin)),
      element('p', {}, `${group.meaning}. ${standingSentence(group)}`),
      ...(group.standing === 'open' ? [whereButton(group, showWhere)] : []), boundTable(group),
      ...costsOf(group), ...remedyOf(group));
}

function whereButton(group, showWhere) {
  return element('button', {class: 'where', onclick: () => showWhere(group.meaning)}, 'Show where');
}

function standingSentence(group) {
  if (group.standing === 'proved') {
    return group.count > 1 ? `All ${group.count} are proved; the tightest:` : 'Proved.';
  }
  const open = group.count > 1 ?
      `${group.open} of ${group.count} ${group.open === 1 ? 'is' : 'are'} not proved` :
      'Not proved';
  if (group.standing === 'absorbed') return `${open}, and absorbed by fine motion.`;
  return `${open}. ${
      group.refuted ? 'At the worst corner it is false.' :
                      'No corner is known where it is false.'}`;
}

function boundTable(group) {
  const row = (name, value) =>
      element('tr', {}, element('th', {scope: 'row'}, name), element('td', {}, value));
  const q = (value) => quantityText(value, group.unit);
  const extreme = group.relation === '<' ? 'at most' : 'at least';
  return element(
      'table', {class: 'bound'}, row('if all is as believed', q(group.nominal)),
      row(`under all errors, ${extreme}`, q(group.bound)),
      row('must be', `${group.relation} ${q(group.limit)}`), row('margin', q(group.margin)));
}

function costsOf(group) {
  const costs = group.costs.filter((cost) => cost.cost > 1e-3 * group.costs[0].cost);
  if (costs.length === 0) return [];
  const rows = costs.map(
      (cost) => element(
          'tr', {}, element('th', {scope: 'row'}, cost.name),
          element('td', {}, rangeText(cost.range, cost.unit)),
          element(
              'td', {class: 'bar'},
              element('i', {style: `width: ${(100 * cost.cost) / costs[0].cost}%`})),
          element('td', {}, quantityText(cost.cost, group.unit))));
  return [element(
      'table', {class: 'costs'},
      element(
          'caption', {}, 'What costs most: how much the bound would gain if the error were known'),
      ...rows)];
}

function remedyOf({remedy, standing}) {
  if (standing !== 'open') return [];
  if (!remedy)
    return [element('p', {}, 'No single error, if it were smaller, would be enough for a proof.')];
  return [element(
      'p', {},
      `Enough for a proof: ${remedy.name} in ${rangeText(remedy.enough, remedy.unit)} ` +
          `instead of ${rangeText(remedy.range, remedy.unit)}.`)];
}

function notNeededOf(step) {
  if (step.notNeeded.length === 0) return [];
  const items =
      step.notNeeded.map(({condition, reason}) => element('li', {}, `${condition}: ${reason}`));
  return [element(
      'details', {class: 'more'},
      element('summary', {}, `${countText(step.notNeeded.length, 'condition')} not asked for`),
      element('ul', {}, ...items))];
}

function doneOf(step) {
  const inserted = step.resolutions.map(
      ({resolver, steps, why}) => element(
          'li', {},
          `${resolver}${steps.length ? ` (step ${steps.join(', ')})` : ''}, because ${why}`));
  const checks = step.verifications.map(({name, expected, tolerance, below, above}) => {
    const errors = [below && `${below} if less`, above && `${above} if more`].filter(Boolean);
    return element(
        'li', {},
        `check ${name}: ${quantityText(expected, 'm')} ± ${quantityText(tolerance, 'm')}; ${
            errors.join(', ')}`);
  });
  const items = [...inserted, ...checks];
  return items.length === 0 ? [] :
                              [element('h3', {}, 'Done about it'), element('ul', {}, ...items)];
}

// What this execution showed about the claims, the worst first.
function observedOf(step, colors) {
  if (step.verdicts.length === 0) return [];
  const rank = (claim) => VERDICTS.indexOf(claim.verdict);
  const claims = [...step.verdicts].sort((a, b) => rank(a) - rank(b));
  const counts =
      VERDICTS.map((name) => [name, claims.filter((claim) => claim.verdict === name).length]);
  const tally = counts.filter(([, count]) => count > 0).map(([name, count]) => `${count} ${name}`);
  return [
    element('h3', {}, `Observed in this execution: ${tally.join(', ')}`),
    element(
        'table', {class: 'observed'},
        element(
            'tr', {},
            ...['', 'claim', 'predicted', 'observed'].map(
                (name) => element('th', {scope: 'col'}, name))),
        ...claims.map((claim) => observedRow(claim, colors)))
  ];
}

function observedRow(claim, colors) {
  const when = claim.about === 'precondition' ? '' : `, ${claim.about}`;
  return element(
      'tr', {style: `--standing: ${colors[claim.verdict]}`},
      element(
          'td', {},
          element('span', {class: 'mark', title: claim.verdict}, VERDICT_MARKS[claim.verdict])),
      element('th', {scope: 'row'}, claim.name + when),
      element('td', {}, rangeText(claim.predicted, claim.unit, 3)),
      element('td', {}, quantityText(claim.observed, claim.unit, 3)));
}
