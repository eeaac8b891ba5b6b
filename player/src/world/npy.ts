/** NPY arrays, version 1: the two types that a world file uses. */

const TYPES = { "<u2": 2, "|b1": 1 } as const;
export type Descr = keyof typeof TYPES;

export interface NpyArray {
  readonly descr: Descr;
  readonly shape: readonly number[];
  /** The values in C order, little-endian, as they lie in the file. */
  readonly bytes: Uint8Array;
}

/** The array in an NPY file. Throws for another version, type or order, and for one that is cut short. */
export function parseNpy(file: Uint8Array): NpyArray {
  const magic = String.fromCharCode(...file.subarray(0, 6));
  if (magic !== "\x93NUMPY" || file[6] !== 1) throw new Error("not an NPY array of version 1");
  const headerEnd = 10 + file[8]! + 256 * file[9]!;
  const header = String.fromCharCode(...file.subarray(10, headerEnd));
  const descr = /'descr':\s*'([^']*)'/.exec(header)?.[1] ?? "";
  const shape = /'shape':\s*\(([\d,\s]*)\)/.exec(header)?.[1];
  if (!isDescr(descr)) throw new Error(`an array of type '${descr}'`);
  if (shape === undefined || !/'fortran_order':\s*False/.test(header))
    throw new Error("an array that is not in C order");
  const sizes = shape
    .split(",")
    .filter((part) => part.trim() !== "")
    .map(Number);
  const bytes = file.subarray(headerEnd);
  const due = sizes.reduce((product, size) => product * size, TYPES[descr]);
  if (bytes.length !== due) throw new Error(`an array of ${bytes.length} bytes where ${due} are due`);
  return { descr, shape: sizes, bytes };
}

/** The values of a `<u2` array, whatever the byte order of the machine and wherever the bytes lie. */
export function uint16(array: NpyArray): Uint16Array {
  if (array.descr !== "<u2") throw new Error(`an array of '${array.descr}' where '<u2' is due`);
  const view = new DataView(array.bytes.buffer, array.bytes.byteOffset, array.bytes.byteLength);
  const values = new Uint16Array(array.bytes.length / 2);
  for (let i = 0; i < values.length; i += 1) values[i] = view.getUint16(2 * i, true);
  return values;
}

function isDescr(text: string): text is Descr {
  return Object.hasOwn(TYPES, text);
}
