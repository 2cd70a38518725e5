// Texts of quantities. The data are in SI; people read millimetres and degrees.
const SHOWN = {
  m: {name: 'mm', factor: 1e-3},
  rad: {name: '°', factor: Math.PI / 180}
};

// Returns the number with so many digits, without zeros at its end, and with a true minus sign.
export function numberText(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return '∞';
  const small = Math.abs(value) < 1e-7 ? 0 : value; // rounding, in any unit that is shown
  return String(Number(small.toPrecision(digits))).replace('-', '−');
}

function beside(number, unit) {
  return unit === undefined ? number : number + (unit.name === '°' ? '' : '\u202f') + unit.name;
}

// Returns the value with its unit: "−23.01 mm".
export function quantityText(value, unit, digits) {
  const shown = SHOWN[unit];
  return beside(
      numberText(value === null ? null : value / (shown ? shown.factor : 1), digits), shown);
}

// Returns the range with its unit: "±2.794 mm", "−1.2 to 3.4 mm", "at least 2 mm".
export function rangeText([low, high], unit, digits) {
  const shown = SHOWN[unit];
  const factor = shown ? shown.factor : 1;
  if (low === null && high === null) return 'unknown';
  if (high === null) return 'at least ' + quantityText(low, unit, digits);
  if (low === null) return 'at most ' + quantityText(high, unit, digits);
  const [a, b] = [numberText(low / factor, digits), numberText(high / factor, digits)];
  if (a === b) return beside(b, shown);
  return beside(a === '−' + b ? '±' + b : `${a} to ${b}`, shown);
}

// Returns a count with its noun: "1 step", "2 steps".
export function countText(count, noun) {
  return `${count} ${noun}${count === 1 ? '' : 's'}`;
}
