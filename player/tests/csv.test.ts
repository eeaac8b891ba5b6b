import { describe, expect, test } from "vitest";
import { parseCsv } from "../src/world/csv";

describe("parseCsv", () => {
  test("reads cells and rows", () => {
    expect(parseCsv("a,b\n1,2\n")).toEqual([
      ["a", "b"],
      ["1", "2"],
    ]);
  });

  test("keeps empty cells, also at the end of a row and of the text", () => {
    expect(parseCsv("a,,\n,b,\n")).toEqual([
      ["a", "", ""],
      ["", "b", ""],
    ]);
    expect(parseCsv("a,")).toEqual([["a", ""]]);
  });

  test("reads quoted cells with commas, quotes and line breaks", () => {
    expect(parseCsv('"a, b","say ""hi""","two\nlines"\nx,,y')).toEqual([
      ["a, b", 'say "hi"', "two\nlines"],
      ["x", "", "y"],
    ]);
    expect(parseCsv('"",""\n')).toEqual([["", ""]]);
  });

  test("takes a last line without a break, and breaks of both kinds", () => {
    expect(parseCsv("a,b\r\n1,2")).toEqual([
      ["a", "b"],
      ["1", "2"],
    ]);
    expect(parseCsv("")).toEqual([]);
  });

  test("refuses a quote without an end", () => {
    expect(() => parseCsv('a,"b')).toThrow("quoted cell");
  });
});
