// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Whether a report's page says of its front what `export --what front --format json` says: node
// page_numbers.mjs report.html front.json. Mean and standard error are computed as the page does, from the
// models in it.

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {meanResponse, predictor, scaledMean} from '../../studies/say/page/web/kriging.js';
import {scaledDeviation} from '../../studies/say/page/web/kriging_error.js';

const [page, table] = process.argv.slice(2).map((file) => readFileSync(file, 'utf8'));
const open = '<script type="application/json" id="report-data">',
  begin = page.indexOf(open) + open.length;
const {front, models, problem} = JSON.parse(page.slice(begin, page.indexOf('</script', begin)));
const {columns, rows} = JSON.parse(table);
const column = (name) => columns.findIndex((c) => c.name === name);
const near = (a, b, what) =>
  assert.ok(Math.abs(a - b) <= 1e-6 * (Math.abs(b) + 1e-3), `${what}: ${a} on the page, ${b} exported`);

assert.equal(rows.length, front.X.length);
rows.forEach((row, i) => {
  assert.equal(front.non_dominated[i], row[column('non_dominated')]);
  problem.responses.forEach(({name, lower}, j) => {
    const {surface} = models[j],
      back = meanResponse(surface),
      z = scaledMean(surface)(front.X[i]),
      deviation = scaledDeviation(surface)(front.X[i]);
    near(Math.max(predictor(surface)(front.X[i]), lower ?? -Infinity), row[column(name)], `${name} of point ${i + 1}`);
    near(
      (back(z + deviation) - back(z - deviation)) / 2,
      row[column(name + '_standard_error')],
      `error of ${name} of point ${i + 1}`,
    );
  });
});
console.log(`${rows.length} points agree`);
