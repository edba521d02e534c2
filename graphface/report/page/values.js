// The values under the pixels: inflated, and put together again from what the predictor left over (report/packing.py).

const NAN = 65533;
const POSITIVE = 65534;
const NEGATIVE = 65535;

async function inflated(index) {
  const stream = new Blob([bytesOf(index)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function predicted(left, above, corner) {
  const low = Math.min(left, above);
  const high = Math.max(left, above);
  return Math.min(high, Math.max(low, left + above - corner));
}

class Values {
  static async of(data) {
    return new Values(data, await Promise.all(data.planes.map(inflated)));
  }

  constructor(data, planes) {
    this.data = data;
    const { height, width, bits } = data;
    const count = height * width;
    const codes = new Uint16Array(count * planes.length);
    const mask = (1 << bits) - 1;
    let at = 0;
    for (const bytes of planes) {
      for (let y = 0, i = 0; y < height; y++) {
        for (let x = 0; x < width; x++, i++, at++) {
          const left = x ? codes[at - 1] : 0;
          const above = y ? codes[at - width] : 0;
          const corner = x && y ? codes[at - width - 1] : 0;
          const zigzag = bits === 8 ? bytes[i] : (bytes[i] << 8) | bytes[count + i];
          codes[at] = (predicted(left, above, corner) + ((zigzag >> 1) ^ -(zigzag & 1))) & mask;
        }
      }
    }
    this.codes = codes;
  }

  // The numbers at a column and row of the packed array, one for each channel.
  at(column, row) {
    const { height, width, channels, low, step, special } = this.data;
    return Array.from({ length: channels }, (_, channel) => {
      const code = this.codes[(channel * height + row) * width + column];
      if (special && code >= NAN) return code === NAN ? NaN : code === POSITIVE ? Infinity : -Infinity;
      return low[channel] + code * step[channel];
    });
  }

  // Where the value stood in the array itself: rows and columns are picked, each from the middle of its share.
  original(column, row) {
    const { height, width, full } = this.data;
    return [Math.floor(((column + 0.5) * full[1]) / width), Math.floor(((row + 0.5) * full[0]) / height)];
  }
}
