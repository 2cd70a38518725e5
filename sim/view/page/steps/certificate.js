import {element} from '../dom.js';
import {countText, quantityText, rangeText} from '../units.js';

import {marginChart} from './margin_chart.js';
import {colorOf, MARKS, standingOf, uncoveredOf} from './standing.js';
import {VERDICT_MARKS, verdictOf, VERDICTS, verdictText} from './standing.js';

// The certificate of one step: what was claimed, how far it is from its limit, and what costs most.
// What was observed comes last, or first if it violates a claim.
// `showWhere` is called with what is to be shown in the picture: a place (see `place` in data.md), or
// bodies and ghosts.
export function certificateOf(step, data, showWhere) {
  const standing = standingOf(step, data.colors);
  const observed = observedOf(step, data.colors);
  const isViolated = verdictOf(step) === 'violated';
  return element(
      'section', {class: 'certificate', 'aria-label': `Certificate of step ${step.number}`},
      element('h2', {}, `Step ${step.number}: ${step.action}`), ...leadsOf(step, standing),
      ...(isViolated ? observed : []), ...factsOf(step, data),
      ...unprovedWaysOf(step, data, showWhere), ...uncoveredTexts(step, data),
      ...step.preconditions.map(
          (group, i) => preconditionOf(group, data.colors, i === 0, showWhere)),
      ...notNeededOf(step), ...doneOf(step), ...(isViolated ? [] : observed));
}

function unprovedWaysOf({unprovedWays}, {colors}, showWhere) {
  return unprovedWays.map((way) => {
    const {condition, text, home, share, marked, ghosts} = way;
    const enough = share === undefined ?
        [] :
        [element(
            'p', {},
            `It would be proved if the tool's pose had only ${Math.round(100 * share)} % of ` +
                'its errors.')];
    const button = marked ? [whereButton(() => showWhere({marked, ghosts}))] : [];
    return element(
        'details',
        {class: 'claim open', open: true, style: `--standing: ${colorOf('open', colors)}`},
        element(
            'summary', {}, element('span', {class: 'mark', title: 'open'}, MARKS.open),
            element('span', {class: 'name'}, home ? `${condition}, way home` : condition)),
        element('p', {}, unprovedText(text)), ...enough, ...button);
  });
}

// The text is about what may happen with errors, or about the errors with which it happens.
function unprovedText(text) {
  return `Not proved: ${text.startsWith('errors ') ? 'there may be' : 'with errors,'} ${text}.`;
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
  const facts = element('table', {class: 'facts'}, ...rows);
  if (step.drawing === undefined) return [facts];
  const drawing = element('div', {class: 'drawing'});
  drawing.innerHTML = data.drawings[step.drawing];
  const enlarge = element(
      'button', {class: 'where', onclick: () => showLarge(drawing.cloneNode(true))},
      'Enlarge the drawing');
  return [facts, drawing, enlarge];
}

// Shows a drawing over the whole page. A click or the escape key closes it.
function showLarge(drawing) {
  const dialog = element(
      'dialog', {class: 'large', onclick: () => dialog.close(), onclose: () => dialog.remove()},
      drawing);
  document.body.append(dialog);
  dialog.showModal();
}

function leadOf(step, standing) {
  if (!step.certified)
    return 'The plan was made without regard to uncertainty, so nothing is certified.';
  const open = step.preconditions.filter((group) => group.standing === 'open');
  if (open.length > 0) return openText(open);
  if (step.preconditions.length === 0)
    return 'The step has no uncertainty-reduction preconditions.';
  const tightest = step.preconditions.find((group) => group.standing === 'proved');
  if (!tightest || step.unprovedWays.length > 0) return `Preconditions: ${standing.text}.`;
  return `Preconditions: ${standing.text}. The least margin is ` +
      `${quantityText(tightest.margin, tightest.unit)}, of ${tightest.condition}.`;
}

function openText(open) {
  const [worst] = open;
  const missing = worst.unborne ?
      'At worst, nothing bears the load.' :
      `${quantityText(-worst.margin, worst.unit)} are missing for a proof.`;
  const first = open.length === 1 ?
      'Not proved' :
      `${open.length} kinds of preconditions are not proved. The worst`;
  return `${first}: ${worst.condition} (${worst.meaning}). ${missing}`;
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
      element('b', {}, group.unborne ? 'no bound' : `${marginText(group, -1)} short`) :
                                       element('span', {}, marginText(group));
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
              element('small', {}, group.count > 1 ? ` ×\u00a0${group.count}` : '')),
          marginChart(group, color), element('span', {class: 'value'}, margin)),
      element('p', {}, `${capitalized(group.meaning)}. ${standingSentence(group)}`),
      boundTable(group),
      ...(group.place ? [whereButton(() => showWhere(group.place))] : []),
      ...costsOf(group), ...remedyOf(group));
}

const capitalized = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function whereButton(onclick) {
  return element(
      'button',
      {class: 'where', title: 'Show in red, in the picture, what decides the condition', onclick},
      'Show where');
}

function marginText({margin, unit, unborne}, sign = 1) {
  return unborne ? '−∞' : quantityText(sign * margin, unit);
}

// Returns whether the precondition is proved. The table below the sentence is about one case.
function standingSentence({standing, count, open, refuted, unborne}) {
  const shown = count > 1 ? ' The case with the least margin:' : '';
  if (standing === 'proved') {
    return `Proved${count > 1 ? ` in all ${count} cases` : ''}.${shown}`;
  }
  const proof = `Not proved${count > 1 ? ` in ${open} of ${count} cases` : ''}`;
  if (standing === 'absorbed') return `${proof}, and absorbed by fine motion.${shown}`;
  const corner =
      refuted ? 'There are errors within their ranges with which it is false.' :
                'No errors within their ranges are known with which it is false.';
  return `${proof}. ${unborne ? 'At worst, nothing bears the load.' : corner}${shown}`;
}

function boundTable(group) {
  const row = (name, value) =>
      element('tr', {}, element('th', {scope: 'row'}, name), element('td', {}, value));
  const q = (value) => quantityText(value, group.unit);
  const extreme = group.relation === '<' ? 'at most' : 'at least';
  const nominal = isNumber(group) ? [] : [row('without errors', q(group.nominal))];
  return element(
      'table', {class: 'bound'}, ...nominal,
      row(`under all errors, ${extreme}`, group.unborne ? '∞' : q(group.bound)),
      row('must be', `${group.relation} ${q(group.limit)}`), row('margin', marginText(group)));
}

function costsOf(group) {
  const costs = group.costs.filter((cost) => cost.cost > 1e-3 * group.costs[0].cost);
  if (costs.length === 0) return [];
  const rows = costs.flatMap((cost) => [
    element(
        'tr', {}, element('th', {scope: 'row'}, cost.name),
        element('td', {}, rangeText(cost.range, cost.unit)),
        element(
            'td', {class: 'bar'},
            element('i', {style: `width: ${(100 * cost.cost) / costs[0].cost}%`})),
        element('td', {}, quantityText(cost.cost, group.unit))),
    ...(cost.meaning ? [element(
                           'tr', {class: 'meaning'},
                           element('td', {colspan: 4}, cost.meaning))] :
                       []),
  ]);
  const heads = ['error', 'range', '', 'cost'].map(
      (name) => element('th', {scope: 'col'}, name));
  return [element(
      'table', {class: 'costs'},
      element(
          'caption', {},
          'The errors that cost most. The cost of an error is the amount by which the bound would ' +
              'improve if this error were known exactly.'),
      element('tr', {}, ...heads), ...rows)];
}

// Whether the planner computed one number for all errors together. Nothing is known about the
// effect of single errors then.
const isNumber = ({nominal}) => nominal === undefined;

function remedyOf(group) {
  const {remedy, standing} = group;
  if (standing !== 'open' || isNumber(group)) return [];
  if (!remedy)
    return [element('p', {}, 'It is not enough for a proof to know one of the errors exactly.')];
  return [element(
      'p', {},
      `A smaller range of ${remedy.name} is enough for a proof: ` +
          `${rangeText(remedy.enough, remedy.unit)} instead of ` +
          `${rangeText(remedy.range, remedy.unit)}.`)];
}

function notNeededOf({notNeeded, unprovedWays}) {
  const isShown = ({condition}) => unprovedWays.some((way) => way.condition === condition);
  const left = notNeeded.filter((kind) => !isShown(kind));
  if (left.length === 0) return [];
  const items = left.map(({condition, reason}) => element('li', {}, `${condition}: ${reason}`));
  return [element(
      'details', {class: 'more'},
      element('summary', {}, `${countText(left.length, 'condition')} not needed`),
      element('ul', {}, ...items))];
}

function doneOf(step) {
  const inserted = step.resolutions.map(
      ({resolver, steps, why}) => element(
          'li', {},
          `${resolver}${steps.length ? ` (step ${steps.join(', ')})` : ''}, because before ` +
              `this it was ${why}`));
  const checks = step.verifications.map(({name, expected, tolerance, below, above}) => {
    const errors = [below && `less means ${below}`, above && `more means ${above}`].filter(Boolean);
    return element(
        'li', {},
        `verification ${name}: expected ${quantityText(expected, 'm')} ± ${
            quantityText(tolerance, 'm')}; ${errors.join('; ')}`);
  });
  const items = [...inserted, ...checks];
  if (items.length === 0) return [];
  return [element('h3', {}, 'What the plan does about errors'), element('ul', {}, ...items)];
}

// What this execution showed about the claims, the worst first.
function observedOf(step, colors) {
  if (step.verdicts.length === 0) return [];
  const rank = (claim) => VERDICTS.indexOf(claim.verdict);
  const claims = [...step.verdicts].sort((a, b) => rank(a) - rank(b));
  const count = (name) => claims.filter((claim) => claim.verdict === name).length;
  const tally = VERDICTS.filter((name) => count(name) > 0)
                    .map((name) => `${count(name)} ${verdictText(name)}`);
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
          element(
              'span', {class: 'mark', title: verdictText(claim.verdict)},
              VERDICT_MARKS[claim.verdict])),
      element('th', {scope: 'row'}, claim.name + when),
      element('td', {}, rangeText(claim.predicted, claim.unit, 3)),
      element('td', {}, quantityText(claim.observed, claim.unit, 3)));
}
