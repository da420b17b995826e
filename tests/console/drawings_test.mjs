// No two things in a drawing of a shipped mission (docs/images/mission_*.svg) lie upon each other, whatever the viewer's
// font: node drawings_test.mjs ANY WORK_FOLDER
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

import { launch, run } from './browser.mjs';

const [, folder] = process.argv.slice(2);
const kImages = 'docs/images';
const browser = await launch(folder);

/** What overlaps or is cut off, in words. A text may lie upon the sign that it is centred in. */
function mistakes(font) {
  const svg = document.querySelector('svg');
  svg.setAttribute('font-family', font);
  const things = [...svg.querySelectorAll('text, tspan, rect:not(:first-child)')].filter((node) => !node.querySelector('tspan'))
    .map((node) => ({ words: node.textContent || 'a sign', sign: node.getAttribute('text-anchor') === 'middle', box: node.getBoundingClientRect() }));
  const page = svg.getBoundingClientRect();
  const found = things.filter(({ box }) => box.right > page.right || box.bottom > page.bottom).map(({ words }) => `cut off: ${words}`);
  const texts = things.filter(({ sign }) => !sign);
  texts.forEach((one, i) => texts.slice(i + 1).forEach((other) => {
    const [a, b] = [one.box, other.box];
    const slack = 0.5;
    if (a.left < b.right - slack && b.left < a.right - slack && a.top < b.bottom - slack && b.top < a.bottom - slack)
      found.push(`${one.words} and ${other.words}`);
  }));
  return found;
}

const drawings = readdirSync(kImages).filter((name) => name.startsWith('mission_'));
const failed = await run(Object.fromEntries(drawings.map((name) => [name, async () => {
  const page = await (await browser.newContext()).newPage();
  await page.setContent(readFileSync(join(kImages, name), 'utf8'));
  for (const font of ['sans-serif', 'serif', 'monospace'])
    assert.deepEqual(await page.evaluate(mistakes, font), [], `in ${font}`);
  return page;
}])));
assert.ok(drawings.length > 10);
await browser.close();
process.exit(failed === 0 ? 0 : 1);
