import {drawing} from '../dom.js';

const WIDTH = 110;
const HEIGHT = 16;

// Draws how errors bring a condition from its value without errors (dot) to its guaranteed bound
// (end of the bar), and how far that is from the limit (line). Some conditions have no value without
// errors, and no dot.
export function marginChart({nominal, bound, limit, standing}, color) {
  const values =
      [nominal, bound, limit].filter(Number.isFinite);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const x = (value) => 6 + ((value - low) / (high - low || 1)) * (WIDTH - 12);
  const bar = (from, to, attributes) => drawing(
      'rect',
      {x: Math.min(x(from), x(to)), width: Math.max(1, Math.abs(x(to) - x(from))), ...attributes});
  const chart =
      drawing('svg', {class: 'margin', width: WIDTH, height: HEIGHT, 'aria-hidden': 'true'});
  if (bound !== null) {
    const gap = {y: 5, height: 6, fill: color, 'fill-opacity': standing === 'proved' ? 0.35 : 1};
    if (nominal !== undefined) {
      const inside = Math.abs(limit - nominal) < Math.abs(bound - nominal) ? limit : bound;
      chart.append(bar(nominal, inside, {y: 5, height: 6, fill: '#8a97a5'}));
    }
    chart.append(bar(bound, limit, gap));
  }
  if (nominal !== undefined) {
    chart.append(drawing('circle', {cx: x(nominal), cy: 8, r: 3.5, fill: '#14202e'}));
  }
  chart.append(drawing('rect', {x: x(limit) - 1, y: 1, width: 2, height: 14, fill: '#14202e'}));
  return chart;
}
