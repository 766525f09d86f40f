// A headless Chromium spoken to through its debugging pipe: no packages, no ports.
import { spawn } from 'node:child_process';

export const pause = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });

export class Browser {
  constructor(program, folder) {
    this.faults = [];  // script errors and console errors
    this.waiting = new Map();
    this.count = 0;
    this.buffer = '';
    this.process = spawn(program, [
      '--headless', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--remote-debugging-pipe', `--user-data-dir=${folder}/profile`, 'about:blank',
    ], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.hasExited = false;
    this.process.on('exit', () => this.end());
    this.process.on('error', () => this.end());
    this.process.stdio[3].on('error', () => this.end());
    this.process.stdio[4].on('data', (data) => this.take(data.toString()));
  }

  end() {
    this.hasExited = true;
    for (const { reject } of this.waiting.values()) reject(new Error('the browser has ended'));
    this.waiting.clear();
  }

  take(text) {
    const parts = (this.buffer + text).split('\0');
    this.buffer = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      const call = this.waiting.get(message.id);
      if (call) {
        this.waiting.delete(message.id);
        if (message.error) call.reject(new Error(message.error.message));
        else call.resolve(message.result);
      } else if (message.method === 'Runtime.exceptionThrown') {
        const details = message.params.exceptionDetails;
        this.faults.push(details.exception?.description ?? details.text);
      } else if (message.method === 'Runtime.consoleAPICalled' && message.params.type === 'error') {
        this.faults.push(message.params.args.map((a) => a.value ?? a.description).join(' '));
      } else if (message.method === 'Log.entryAdded' && message.params.entry.level === 'error') {
        this.faults.push(message.params.entry.text);
      }
    }
  }

  send(method, params = {}) {
    if (this.hasExited) return Promise.reject(new Error('the browser has ended'));
    const id = ++this.count;
    const message = { id, method, params, ...(this.session && { sessionId: this.session }) };
    this.process.stdio[3].write(`${JSON.stringify(message)}\0`);
    return new Promise((resolve, reject) => { this.waiting.set(id, { resolve, reject }); });
  }

  async open(url, width = 1280, height = 900) {
    if (!this.session) {
      const { targetInfos } = await this.send('Target.getTargets');
      const { targetId } = targetInfos.find((t) => t.type === 'page');
      const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
      this.session = sessionId;
      await this.send('Runtime.enable');
      await this.send('Log.enable');
      await this.send('Page.enable');
    }
    await this.send('Emulation.setDeviceMetricsOverride',
                    { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send('Page.navigate', { url });
    await this.until('document.readyState === "complete"');
  }

  async value(expression) {
    const { result } = await this.send('Runtime.evaluate', { expression, returnByValue: true });
    return result.value;
  }

  async until(expression, seconds = 20) {
    for (let i = 0; i < 10 * seconds; ++i) {
      if (await this.value(expression)) return true;
      await pause(100);
    }
    return false;
  }

  close() { this.process.kill(); }
}
