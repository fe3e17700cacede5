// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Rows as text for other programs, with all digits, and the ways out of the page.

const field = (value) => (value === null || value === undefined || Number.isNaN(value) ? '' : String(value));
const quoted = (text) => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const onOneLine = (text) => text.replace(/[\t\r\n]+/g, ' ');

export const csv = (rows) => rows.map((row) => row.map((value) => quoted(field(value))).join(',') + '\r\n').join('');
export const tsv = (rows) => rows.map((row) => row.map((value) => onOneLine(field(value))).join('\t') + '\n').join('');

/// A name for a file from words.
export const fileName = (...words) =>
  words
    .join(' ')
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, '_')
    .replace(/^_|_$/g, '');

export function download(name, text, type) {
  const address = URL.createObjectURL(new Blob([text], {type}));
  const anchor = Object.assign(document.createElement('a'), {href: address, download: name});
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/// True if the text is on the clipboard. Not every browser lets a file use it in the same way.
export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = Object.assign(document.createElement('textarea'), {value: text});
    document.body.append(area);
    area.select();
    const done = document.execCommand('copy');
    area.remove();
    return done;
  }
}
