// Decodes series of whole numbers (page/data.md). Numbers of up to 53 bits are exact.
export class SeriesReader {
  constructor(dataUri) {
    const text = atob(dataUri.slice(dataUri.indexOf(',') + 1));
    this.bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
    this.at = 0;
  }

  number() {
    let value = 0;
    for (let scale = 1;; scale *= 128) {
      const byte = this.bytes[this.at++];
      value += (byte % 128) * scale;
      if (byte < 128) return value;
    }
  }

  // Returns the next series, of this length, in units of `quantum`.
  next(length, quantum) {
    const order = this.bytes[this.at++];
    const values = new Float64Array(length);
    let zeros = 0;
    for (let i = 0; i < length; ++i) {
      let difference = 0;
      if (zeros > 0)
        --zeros;
      else {
        const code = this.number();
        if (code === 0)
          zeros = this.number();
        else
          difference = code % 2 === 0 ? code / 2 : -(code + 1) / 2;
      }
      const last = i > 0 ? values[i - 1] : 0;
      const slope = order === 2 && i > 1 ? last - values[i - 2] : 0;
      values[i] = last + slope + difference;
    }
    return values.map((value) => value * quantum);
  }
}
