// The values under the pixels of a picture, as graphface.report.packing packs them; every page that shows values has this.

const NAN = 65533;
const POSITIVE = 65534;
const NEGATIVE = 65535;

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function predicted(left, above, corner) {
  const low = Math.min(left, above);
  const high = Math.max(left, above);
  return Math.min(high, Math.max(low, left + above - corner));
}

// The codes of all channels, plane after plane: what the predictor left over, put together again. `bytesOf` gives the
// compressed bytes of a plane.
async function unpackedCodes(packed, bytesOf) {
  const planes = await Promise.all(packed.planes.map((plane) => inflated(bytesOf(plane))));
  const { height, width, bits } = packed;
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
  return codes;
}

// The number that a code of a channel stands for.
function numberOf(packed, code, channel) {
  if (packed.special && code >= NAN) return code === NAN ? NaN : code === POSITIVE ? Infinity : -Infinity;
  return packed.low[channel] + code * packed.step[channel];
}
