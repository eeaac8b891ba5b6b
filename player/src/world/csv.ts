/** The rows of a CSV text (RFC 4180): quoted cells may hold commas, line breaks and doubled quotes. */
export function parseCsv(text: string): string[][] {
  const rows: string[][] = [];
  let row: string[] = [];
  let at = 0;
  while (at < text.length) {
    const cell = text[at] === '"' ? quoted(text, at) : plain(text, at);
    row.push(cell.value);
    at = cell.next;
    if (text[at] === ",") {
      at += 1;
      if (at === text.length) row.push("");
      continue;
    }
    rows.push(row);
    row = [];
    at += text[at] === "\r" && text[at + 1] === "\n" ? 2 : 1;
  }
  if (row.length > 0) rows.push(row);
  return rows;
}

interface Cell {
  readonly value: string;
  /** Where the separator after the cell stands, or the end of the text. */
  readonly next: number;
}

function plain(text: string, from: number): Cell {
  let next = from;
  while (next < text.length && !",\r\n".includes(text[next]!)) next += 1;
  return { value: text.slice(from, next), next };
}

function quoted(text: string, from: number): Cell {
  let value = "";
  let start = from + 1;
  for (;;) {
    const end = text.indexOf('"', start);
    if (end < 0) throw new Error("a quoted cell without an end");
    value += text.slice(start, end);
    if (text[end + 1] !== '"') return { value, next: end + 1 };
    value += '"';
    start = end + 2;
  }
}
