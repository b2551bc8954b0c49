/** The little markup of labels: `*tau*` is italic and `_{imp}` a subscript. */

export interface Run {
  readonly text: string;
  readonly italic: boolean;
  readonly subscript: boolean;
}

const cache = new Map<string, readonly Run[]>();

export function parseRichText(text: string): readonly Run[] {
  const known = cache.get(text);
  if (known !== undefined) return known;
  const runs: Run[] = [];
  let italic = false;
  let subscript = false;
  let word = "";
  const flush = () => {
    if (word !== "") runs.push({ text: word, italic, subscript });
    word = "";
  };
  for (let index = 0; index < text.length; index += 1) {
    const letter = text[index] ?? "";
    if (letter === "*") {
      flush();
      italic = !italic;
    } else if (letter === "_" && text[index + 1] === "{") {
      flush();
      subscript = true;
      index += 1;
    } else if (letter === "}" && subscript) {
      flush();
      subscript = false;
    } else {
      word += letter;
    }
  }
  flush();
  // Labels are few; ticks of endless zooms are not.
  if (cache.size > 500) cache.clear();
  cache.set(text, runs);
  return runs;
}

/** The same without markup, for plain text. */
export function plainText(text: string): string {
  return parseRichText(text)
    .map((run) => run.text)
    .join("");
}
