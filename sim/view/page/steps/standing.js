// How a precondition stands: proved, absorbed by fine motion, or open.
export const MARKS = {
  proved: '✓',
  absorbed: '≈',
  open: '!'
};

export function colorOf(standing, colors) {
  return {
    proved: colors.contained,
    absorbed: colors.predicted,
    open: colors.inconclusive
  }[standing];
}

// Returns how a step's certificate stands as a whole, in words and by colour.
export function standingOf(step, colors) {
  const total = (key, holds) =>
      step.preconditions.filter(holds).reduce((sum, group) => sum + group[key], 0);
  const all = total('count', () => true);
  const open = total('open', (group) => group.standing === 'open');
  const absorbed = total('open', (group) => group.standing === 'absorbed');
  if (!step.certified) {
    return {text: 'no certificate', mark: '–', color: colors['not-claimed'], isOpen: false};
  }
  if (open === 0 && step.unprovedWays.length > 0) {
    const color = colorOf('open', colors);
    return {text: `${all} proved, the arm's way not`, mark: MARKS.open, color, isOpen: true};
  }
  if (all === 0) {
    return {text: 'nothing to prove', mark: MARKS.proved, color: colors.contained, isOpen: false};
  }
  const kind = open > 0 ? 'open' : absorbed > 0 ? 'absorbed' : 'proved';
  const text = open > 0 ? `${open} of ${all} not proved` :
      absorbed > 0 ? `${all - absorbed} proved, ${absorbed} absorbed` :
                     `${all} proved`;
  return {text, mark: MARKS[kind], color: colorOf(kind, colors), isOpen: open > 0};
}

// Returns one sentence about all certificates.
export function summaryOf(data) {
  if (data.summary) return data.summary;
  const open =
      data.steps.filter((step) => step.preconditions.some((kind) => kind.standing === 'open'));
  const certified = data.steps.filter((step) => step.certified);
  if (data.tree && certified.length === 0) {
    return 'The plan tree is about knowledge. The executor compared what it claims to know with the truth.';
  }
  if (certified.length === 0) return 'The plan was made without regard to uncertainty.';
  if (open.length === 0) {
    const absorbs = data.steps.some((s) => s.preconditions.some((p) => p.standing === 'absorbed'));
    const ways = data.steps.filter((step) => step.unprovedWays.length > 0);
    const whose = data.asPublished ? ' of the paper' : '';
    return `Every precondition${whose} is proved${absorbs ? ', or absorbed by fine motion' : ''}${
        ways.length > 0 ? `, except for the arm's way in ${stepsText(ways)}` : ''}.`;
  }
  return `Some preconditions of ${stepsText(open)} are not proved.`;
}

function stepsText(steps) {
  return `step${steps.length === 1 ? '' : 's'} ${steps.map((step) => step.number).join(', ')}`;
}

// Returns what no precondition of a step covers: the sentences that end in the step's number. What
// is shown as an unproved way is left out.
export function uncoveredOf(step, data) {
  if (step.unprovedWays.length > 0) return [];
  return data.notCovered.filter((sentence) => {
    const found = sentence.match(/: steps? ([\d, ]+)$/);
    return found !== null && found[1].split(',').map(Number).includes(step.planNumber);
  });
}

// Verdicts of trials: the worst first.
export const VERDICTS = ['violated', 'inconclusive', 'contained', 'not-claimed'];
export const VERDICT_MARKS = {
  violated: '✗',
  inconclusive: '?',
  contained: '✓',
  'not-claimed': '–'
};

export const verdictText = (verdict) => verdict.replace('-', ' ');

export function verdictOf(step) {
  return VERDICTS.find((name) => step.verdicts.some((claim) => claim.verdict === name));
}
