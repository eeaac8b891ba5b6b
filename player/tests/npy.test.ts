import { describe, expect, test } from "vitest";
import { parseNpy, uint16 } from "../src/world/npy";

function npy(descr: string, shape: string, data: readonly number[], order = "False"): Uint8Array {
  const header = `{'descr': '${descr}', 'fortran_order': ${order}, 'shape': ${shape}, }`.padEnd(117) + "\n";
  const letters = [...`\x93NUMPY\x01\x00${String.fromCharCode(header.length)}\x00${header}`].map((c) =>
    c.charCodeAt(0),
  );
  return Uint8Array.from([...letters, ...data]);
}

describe("parseNpy", () => {
  test("reads 16-bit numbers, little-endian, wherever the bytes lie", () => {
    const file = npy("<u2", "(2, 1)", [1, 2, 255, 255]);
    const shifted = new Uint8Array(file.length + 1);
    shifted.set(file, 1);
    const array = parseNpy(shifted.subarray(1));
    expect(array.shape).toEqual([2, 1]);
    expect([...uint16(array)]).toEqual([513, 65535]);
  });

  test("reads booleans and arrays of one and of no axis of length", () => {
    expect([...parseNpy(npy("|b1", "(3,)", [1, 0, 1])).bytes]).toEqual([1, 0, 1]);
    expect(parseNpy(npy("|b1", "(0, 4)", [])).shape).toEqual([0, 4]);
  });

  test.each([
    ["another type", npy("<f8", "(1,)", [0, 0, 0, 0, 0, 0, 0, 0]), "type '<f8'"],
    ["Fortran order", npy("<u2", "(1,)", [0, 0], "True"), "C order"],
    ["too few bytes", npy("<u2", "(2,)", [0, 0]), "2 bytes where 4"],
    ["another file", Uint8Array.from([1, 2, 3]), "not an NPY array"],
  ])("refuses %s", (_, file, said) => {
    expect(() => parseNpy(file)).toThrow(said);
  });

  test("refuses booleans where numbers are due", () => {
    expect(() => uint16(parseNpy(npy("|b1", "(1,)", [1])))).toThrow("'<u2' is due");
  });
});
