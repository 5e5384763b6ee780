// SPDX-License-Identifier: MIT
//
// chromium.js - a headless Chromium by its DevTools protocol, over pipes: no package is needed.
//
//     const browser = await open(folder);      where its profile goes
//     const page = await browser.page();       page.errors: what its console and its network complained of
//     await page.size(375, 667); await page.go('file:///...'); await page.run('1 + 1'); await page.close();
'use strict';
const { spawn } = require('child_process'), fs = require('fs');

async function open(folder) {
    const child = spawn('chromium', ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--no-first-run',
        '--disable-extensions', '--disable-background-networking', '--disable-component-update', '--hide-scrollbars',
        '--remote-debugging-pipe', `--user-data-dir=${folder}`, 'about:blank'],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    const waiting = new Map(), listeners = [];
    let next = 1, rest = '';
    const ended = new Promise((resolve, reject) => child.on('error', reject).on('exit', resolve));
    child.stdio[4].setEncoding('utf8').on('data', data => {
        const messages = (rest + data).split('\0');
        rest = messages.pop();
        for (const message of messages.map(text => JSON.parse(text))) {
            if (!message.id) {
                listeners.forEach(listener => listener(message));
                continue;
            }
            const { resolve, reject } = waiting.get(message.id);
            waiting.delete(message.id);
            if (message.error) reject(new Error(message.error.message));
            else resolve(message.result);
        }
    });
    const send = (method, params = {}, sessionId = undefined) => new Promise((resolve, reject) => {
        waiting.set(next, { resolve, reject });
        child.stdio[3].write(JSON.stringify({ id: next++, method, params, sessionId }) + '\0');
        ended.then(() => reject(new Error('chromium has ended')), reject);
    });
    return {
        async page() {
            const { targetId } = await send('Target.createTarget', { url: 'about:blank' });
            const { sessionId } = await send('Target.attachToTarget', { targetId, flatten: true });
            const errors = [], requests = [], waits = [];
            const call = (method, params) => send(method, params, sessionId);
            listeners.push(({ method, params, sessionId: from }) => {
                if (from !== sessionId) return;
                if (method === 'Runtime.exceptionThrown') errors.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
                if (method === 'Runtime.consoleAPICalled' && ['error', 'warning'].includes(params.type)) errors.push(params.args.map(a => a.value || a.description).join(' '));
                if (method === 'Log.entryAdded' && ['error', 'warning'].includes(params.entry.level)) errors.push(params.entry.text);
                if (method === 'Network.requestWillBeSent') requests.push(params.request.url);
                if (method === 'Page.loadEventFired') waits.splice(0).forEach(resolve => resolve());
            });
            for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await call(`${domain}.enable`);
            return {
                errors,
                requests,
                call,
                size: (width, height) => call('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 500 }),
                feature: (name, value) => call('Emulation.setEmulatedMedia', { features: [{ name, value }] }),
                async go(url) {
                    const loaded = new Promise(resolve => waits.push(resolve));
                    await call('Page.navigate', { url });
                    await loaded;
                },
                async run(expression) {
                    const { result, exceptionDetails } = await call('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true, userGesture: true });
                    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
                    return result.value;
                },
                async key(key) {
                    const more = key === ' ' ? { key, code: 'Space', text: ' ', windowsVirtualKeyCode: 32 } : { key, code: key };
                    await call('Input.dispatchKeyEvent', { type: 'keyDown', ...more });
                    await call('Input.dispatchKeyEvent', { type: 'keyUp', ...more });
                },
                mouse: (type, x, y) => call('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1 }),
                async picture() {
                    return Buffer.from((await call('Page.captureScreenshot', { format: 'png' })).data, 'base64');
                },
                close: () => send('Target.closeTarget', { targetId }),
            };
        },
        async close() {
            send('Browser.close').catch(() => {});
            await ended;
            fs.rmSync(folder, { recursive: true, force: true });
        },
    };
}
module.exports = { open };
