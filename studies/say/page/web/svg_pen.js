// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// As much of a canvas's pen as the plots below a scene use, writing SVG.

const escaped = (text) =>
  String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('"', '&quot;');
const anchors = {left: 'start', center: 'middle', right: 'end'};

export class SvgPen {
  constructor(width, height) {
    this.width = width;
    this.height = height;
    this.parts = [];
    this.path = this.dash = '';
    this.fillStyle = this.strokeStyle = '#000';
    this.lineWidth = 1;
    this.font = '11px sans-serif';
    this.textAlign = 'left';
    this.textBaseline = 'alphabetic';
  }

  setLineDash(lengths) {
    this.dash = lengths.length ? ` stroke-dasharray="${lengths}"` : '';
  }
  beginPath() {
    this.path = '';
  }
  moveTo(x, y) {
    this.path += `M${x.toFixed(2)} ${y.toFixed(2)}`;
  }
  lineTo(x, y) {
    this.path += `L${x.toFixed(2)} ${y.toFixed(2)}`;
  }
  stroke() {
    this.parts.push(
      `<path d="${this.path}" fill="none" stroke="${escaped(this.strokeStyle)}" ` +
        `stroke-width="${this.lineWidth}" stroke-linejoin="bevel"${this.dash}/>`,
    );
  }
  fillText(text, x, y) {
    this.parts.push(
      `<text x="${x.toFixed(2)}" y="${y.toFixed(2)}" fill="${escaped(this.fillStyle)}" ` +
        `text-anchor="${anchors[this.textAlign]}"` +
        (this.textBaseline === 'middle' ? ' dominant-baseline="central"' : '') +
        ` style="font:${escaped(this.font)}">${escaped(text)}</text>`,
    );
  }

  /// All that was drawn, on a ground of this colour.
  text(ground) {
    const {width, height} = this;
    return (
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ` +
      `${height}"><rect width="100%" height="100%" fill="${escaped(ground)}"/>${this.parts.join('')}</svg>`
    );
  }
}
