// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A headless Chromium with one page, driven over the DevTools protocol by a pipe: mouse and keys come from
// the browser as a hand's would. It keeps what the console says of errors, and every request that is not the
// page.

import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const words = [
  '--headless=new',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--no-first-run',
  '--disable-extensions',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--disable-dev-shm-usage',
  '--no-sandbox',
  '--window-size=1280,900',
  '--remote-debugging-pipe',
  '--blink-settings=primaryHoverType=2,availableHoverTypes=2,primaryPointerType=4,availablePointerTypes=4',
]; // a mouse
const patience = 60000; // [ms]
const keys = {
  Space: [' ', 32],
  ArrowRight: ['ArrowRight', 39],
  ArrowLeft: ['ArrowLeft', 37],
  Home: ['Home', 36],
  End: ['End', 35],
  Enter: ['Enter', 13],
};

/// Messages over the pipe: {send(method, params, session), on(listener)}.
function protocol(program) {
  const output = program.stdio[4],
    waiting = new Map(),
    listeners = [];
  let last = 0,
    rest = '';
  output.setEncoding('utf8');
  output.on('data', (text) => {
    const parts = (rest + text).split('\0');
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part),
        known = waiting.get(message.id);
      if (!known) {
        listeners.forEach((f) => f(message));
        continue;
      }
      waiting.delete(message.id);
      if (message.error) known.reject(new Error(`${known.method}: ${message.error.message}`));
      else known.resolve(message.result);
    }
  });
  const send = (method, params = {}, sessionId = undefined) =>
    new Promise((resolve, reject) => {
      waiting.set(++last, {method, resolve, reject});
      program.stdio[3].write(JSON.stringify({id: last, method, params, sessionId}) + '\0');
    });
  return {send, on: (f) => listeners.push(f)};
}

/// A page, drawn: of a file by its path, or of a server by its address. downloads: the folder for what it saves.
export async function openPage(place, {downloads = null} = {}) {
  const served = place.startsWith('http://'),
    address = served ? place : 'file://' + encodeURI(place);
  const profile = mkdtempSync(join(tmpdir(), 'page-'));
  const program = spawn(process.env.DRAWPOINT_BROWSER ?? 'chromium', [...words, '--user-data-dir=' + profile], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'],
  });
  process.once('exit', () => {
    program.kill('SIGKILL');
    rmSync(profile, {recursive: true, force: true});
  }); // however it ends
  const {send: sendAny, on} = protocol(program);
  const ended = new Promise((resolve) => program.on('exit', resolve));
  const close = async () => {
    await Promise.race([sendAny('Browser.close').catch(() => {}), ended]);
    await ended;
    rmSync(profile, {recursive: true, force: true, maxRetries: 5});
  };
  const {product} = await sendAny('Browser.getVersion');
  const {targetId} = await sendAny('Target.createTarget', {url: 'about:blank'});
  const {sessionId} = await sendAny('Target.attachToTarget', {targetId, flatten: true});
  const send = (method, params) => sendAny(method, params, sessionId);
  const errors = [],
    requests = [];
  on(({method, params}) => {
    if (method === 'Runtime.exceptionThrown')
      errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && params.type === 'error')
      errors.push(params.args.map((a) => a.value ?? a.description).join(' '));
    if (method === 'Log.entryAdded' && params.entry.level === 'error') errors.push(params.entry.text);
    if (method === 'Network.requestWillBeSent' && !/^(data|blob|about):/.test(params.request.url))
      requests.push(params.request.url);
  });
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await send(domain + '.enable');
  await send('Performance.enable', {timeDomain: 'threadTicks'});
  await send('Emulation.setDeviceMetricsOverride', {width: 1280, height: 900, deviceScaleFactor: 1, mobile: false});
  if (downloads) await sendAny('Browser.setDownloadBehavior', {behavior: 'allow', downloadPath: downloads});
  const page = {...hands(send), product, errors, send, close};
  page.load = async () => {
    await send('Page.navigate', {url: 'about:blank'});
    await send('Page.navigate', {url: address});
    await page.until('document.documentElement?.dataset.ready === "true"', 4 * patience);
    await page.evaluate("document.documentElement.style.scrollBehavior = 'auto'"); // a click aims at what stands still
  };
  const begin = performance.now();
  await page.load();
  page.loaded = performance.now() - begin;
  /// Of the page's main thread so far [ms].
  page.processor = async () =>
    1000 * (await send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration').value;
  /// All but the page itself, or what its server gives.
  page.requests = () => requests.filter((url) => (served ? !url.startsWith(address) : url !== address));
  return page;
}

/// What one does with a page. Places are elements, by expressions of the page.
function hands(send) {
  const evaluate = async (expression) => {
    const {result, exceptionDetails} = await send('Runtime.evaluate', {
      expression,
      awaitPromise: true,
      returnByValue: true,
    });
    if (exceptionDetails)
      throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  };
  const until = async (condition, within = patience) => {
    for (const begin = Date.now(); !(await evaluate(`Boolean(${condition})`));) {
      if (Date.now() - begin > within) throw new Error(`not so after ${within} ms: ${condition}`);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  };
  /// Once two frames have been drawn.
  const settled = () =>
    evaluate('new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => resolve(true))))');
  /// The place of a share of an element, which comes into view.
  const place = async (element, [across, down] = [0.5, 0.5]) => {
    await evaluate(`(${element}).scrollIntoView({block: 'center', behavior: 'instant'})`);
    await settled();
    return evaluate(
      `(() => { const r = (${element}).getBoundingClientRect(); return [r.left + ${across} * r.width, r.top + ` +
        `${down} * r.height]; })()`,
    );
  };
  const mouse = (type, [x, y], more = {}) =>
    send('Input.dispatchMouseEvent', {
      type,
      x,
      y,
      button: 'left',
      buttons: type === 'mouseReleased' ? 0 : 1,
      clickCount: 1,
      ...more,
    });
  const click = async (element, share) => {
    const at = await place(element, share);
    await mouse('mouseMoved', at, {buttons: 0, button: 'none'});
    await mouse('mousePressed', at);
    await mouse('mouseReleased', at);
    await settled();
  };
  const drag = async (element, from, to, steps = 8) => {
    const a = await place(element, from),
      b = await place(element, to),
      way = (share) => a.map((v, k) => v + share * (b[k] - v));
    await mouse('mousePressed', a);
    for (let k = 1; k <= steps; ++k) await mouse('mouseMoved', way(k / steps));
    await mouse('mouseReleased', b);
    await settled();
  };
  const press = async (name, shift = false) => {
    const [key, code] = keys[name],
      modifiers = shift ? 8 : 0;
    for (const type of ['keyDown', 'keyUp'])
      await send('Input.dispatchKeyEvent', {
        type,
        key,
        code: name,
        windowsVirtualKeyCode: code,
        modifiers,
        ...(type === 'keyDown' && key === ' ' ? {text: ' '} : {}),
      });
    await settled();
  };
  const type = async (text) => {
    await send('Input.insertText', {text});
    await settled();
  };
  const wheel = async (element, deltaY) => {
    const [x, y] = await place(element);
    await send('Input.dispatchMouseEvent', {type: 'mouseWheel', x, y, deltaX: 0, deltaY});
    await settled();
  };
  /// Of a list to choose from, as if chosen.
  const choose = async (element, value) => {
    await evaluate(
      `(() => { const box = ${element}; box.value = ${JSON.stringify(value)}; box.dispatchEvent(new ` +
        `Event('change')); })()`,
    );
    await settled();
  };
  return {evaluate, until, settled, place, mouse, click, drag, press, type, wheel, choose};
}
