// Base64 blocks of the report's JSON to typed arrays.

function bytes(text) {
  const raw = atob(text);
  const out = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) out[i] = raw.charCodeAt(i);
  return out.buffer;
}

export const floats = (text) => new Float32Array(bytes(text));
export const integers = (text) => new Uint32Array(bytes(text));
