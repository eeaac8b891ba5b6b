/** Values out of a parsed JSON text, each checked for its kind; `where` names the place in the error. */

export type Json = null | boolean | number | string | readonly Json[] | { readonly [key: string]: Json };

export function entry(value: Json | undefined, key: string, where: string): Json {
  if (typeof value !== "object" || value === null || Array.isArray(value)) throw new Error(`${where} is no object`);
  const found = (value as { readonly [key: string]: Json })[key];
  if (found === undefined) throw new Error(`${where} has no ${key}`);
  return found;
}

export function list(value: Json, where: string): readonly Json[] {
  if (!Array.isArray(value)) throw new Error(`${where} is no list`);
  return value as readonly Json[];
}

export function number(value: Json | undefined, where: string): number {
  if (typeof value !== "number" || !Number.isFinite(value)) throw new Error(`${where} is no number`);
  return value;
}

/** A number from 0 that counts or names something, below `below`. */
export function index(value: Json | undefined, below: number, where: string): number {
  const found = number(value, where);
  if (!Number.isInteger(found) || found < 0 || found >= below) throw new Error(`${where} is ${found}`);
  return found;
}

export function text(value: Json | undefined, where: string): string {
  if (typeof value !== "string") throw new Error(`${where} is no text`);
  return value;
}

export function pair(value: Json, where: string): readonly [number, number] {
  const [first, second] = list(value, where);
  return [number(first, where), number(second, where)];
}
