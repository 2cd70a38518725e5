export const plainName = (name) => name.replace(/^part\//, '');
const escaped = (name) => name.replace(/[.*+?^${}()|[\]\\/]/g, '\\$&');

// Returns the names of the bodies that a sentence names: parts by their names, links of robots as
// "arm/forearm".
export function bodiesNamedIn(text, data) {
  return data.bodies.map((body) => body.name).filter((name) => {
    return name !== 'world' &&
        new RegExp(`(^|[^\\w/-])${escaped(plainName(name))}($|[^\\w/-])`).test(text);
  });
}
