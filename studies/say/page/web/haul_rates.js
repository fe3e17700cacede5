// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What strategies give with another haul: load over the time of a cycle and its haul.

/// What the models say.
export const rateOf = ({load, seconds}, haul) => load / (seconds + haul);

/// What a run gave: the mean of its cycles' rates.
export const rateOfRun = ({loads, seconds}, haul) =>
  loads.reduce((sum, load, c) => sum + load / (seconds[c] + haul), 0) / loads.length;

/// [{strategy, rate}], the highest first.
export const ranked = (strategies, haul) =>
  strategies.map((strategy) => ({strategy, rate: rateOf(strategy, haul)})).sort((a, b) => b.rate - a.rate);

/// "18 s", or "more than 600 s" where it is not within what is asked about.
const seconds = (value, longest) => (value === null ? `more than ${longest} s` : `${Math.round(value)} s`);

/// In a sentence each; the first ones where there are many.
export function turnTexts({turns, strategies, longest}, most = 6) {
  const texts = turns
    .slice(0, most)
    .map(
      ({haul, better, worse, lower, upper}) =>
        `From ${seconds(haul, longest)} on “${strategies[better].name}” gives more than “${strategies[worse].name}” ` +
        `(the turn lies between ${seconds(lower, longest)} and ${seconds(upper, longest)} with 95 %).`,
    );
  if (turns.length > most) texts.push(`${turns.length - most} more turns follow.`);
  return texts.length ? texts : [`The order does not turn for hauls up to ${longest} s.`];
}
