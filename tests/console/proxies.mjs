// Proxies in front of the page, and what must work through each of them.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import http from 'node:http';
import https from 'node:https';
import { connect, createServer } from 'node:net';
import { join } from 'node:path';
import { createServer as createTlsServer } from 'node:tls';

import { kPatience, skip } from './browser.mjs';

/** The files of a certificate that nobody has signed: {cert, key}. */
export function certificate(folder) {
  mkdirSync(folder, { recursive: true });
  const cert = join(folder, 'field.pem'), key = join(folder, 'field.key');
  try {
    execFileSync('openssl', ['req', '-x509', '-newkey', 'rsa:2048', '-nodes', '-days', '2', '-subj', '/CN=field.example',
      '-keyout', key, '-out', cert], { stdio: 'pipe' });
  } catch (error) {
    skip(`openssl made no certificate: ${error.message}`);
  }
  return { cert, key };
}

const kLogin = 'HTTP/1.1 401 Unauthorized\r\nWWW-Authenticate: Basic realm="field"\r\nConnection: close\r\nContent-Length: 0\r\n\r\n';
const kNotFound = 'HTTP/1.1 404 Not Found\r\nConnection: close\r\nContent-Length: 0\r\n\r\n';

/**
 * What nginx does where only `proxy_pass` is written: each request goes on by HTTP/1.0 with another Host, without Upgrade,
 * and one answer is all that comes back. `routes`: the port behind each path, such as {'/swiftlet/': 8080}, which may be
 * filled in later. `strips`: the path is taken off. `keeps` tells of a header whether it is passed on all the same.
 * `login`: "user:password" that the proxy itself asks for. `missed` are the targets that lay below no path.
 */
export async function startProxy({ tls, routes, strips = true, version = '1.0', keeps = () => false, login }) {
  const missed = [];
  const pass = (client, head, rest) => {
    const [line, ...headers] = head.split('\r\n');
    const [method, target] = line.split(' ');
    if (login && !headers.some((header) => header.toLowerCase().startsWith('authorization:') && header.endsWith(` Basic ${btoa(login)}`))) {
      client.end(kLogin);
      return;
    }
    const path = Object.keys(routes).find((known) => target.startsWith(known) || (!strips && target.split('?')[0] === known.slice(0, -1)));
    if (!path) {
      if (target !== '/favicon.ico') missed.push(target);
      client.end(kNotFound);
      return;
    }
    const server = connect(routes[path], '127.0.0.1');
    const kept = headers.filter((header) => keeps(header) || !/^(host|connection|upgrade):/i.test(header));
    if (!kept.some((header) => /^host:/i.test(header))) kept.unshift(`Host: 127.0.0.1:${routes[path]}`);
    if (!kept.some((header) => /^connection:/i.test(header))) kept.unshift('Connection: close');
    server.write([`${method} ${strips ? `/${target.slice(path.length)}` : target} HTTP/${version}`, ...kept, '', ''].join('\r\n'), 'latin1');
    server.write(rest);
    client.pipe(server).pipe(client);
    for (const [end, other] of [[client, server], [server, client]]) end.on('error', () => {}).on('close', () => other.destroy());
  };
  const take = (client) => {
    let bytes = Buffer.alloc(0);
    client.on('error', () => {});
    client.on('data', function first(more) {
      bytes = Buffer.concat([bytes, more]);
      const end = bytes.indexOf('\r\n\r\n');
      if (end < 0) return;
      client.off('data', first);
      pass(client, bytes.toString('latin1', 0, end), bytes.subarray(end + 4));
    });
  };
  const files = tls && { cert: readFileSync(tls.cert), key: readFileSync(tls.key) };
  const listener = tls ? createTlsServer(files, take) : createServer(take);
  await new Promise((done) => listener.listen(0, '127.0.0.1', done));
  return { port: listener.address().port, missed, close: () => listener.close() };
}

/** One request to the public `url`, which leads to this machine: {status, headers, socket} or, with a body, {body}. */
function ask(url, path, { method = 'GET', headers = {}, read = true } = {}) {
  const asked = new URL(path, url);
  return new Promise((done, failed) => {
    const request = (asked.protocol === 'https:' ? https : http).request({
      host: '127.0.0.1', port: asked.port, path: asked.pathname + asked.search, method, agent: false, rejectUnauthorized: false,
      servername: 'field.example', headers: { Host: asked.host, ...headers },
    });
    request.setTimeout(10_000 * kPatience, () => request.destroy(new Error(`no answer to ${method} ${asked}`)));
    request.on('error', failed);
    request.on('upgrade', ({ statusCode: status }, socket, first) => done({ status, socket, first }));
    request.on('response', (response) => {
      const { statusCode: status, headers: answered } = response;
      if (!read) { done({ status, headers: answered, response }); return; }
      const chunks = [];
      response.on('data', (chunk) => chunks.push(chunk)).on('error', failed)
        .on('end', () => done({ status, headers: answered, body: Buffer.concat(chunks).toString('latin1') }));
    });
    request.end();
  });
}

/** How many pictures of a stream of ten a second arrive in two seconds. */
async function pictures(url) {
  const { status, response } = await ask(url, 'stream/map.mjpg?width=320&fps=10', { read: false });
  assert.equal(status, 200, 'the stream');
  let text = '';
  response.on('data', (chunk) => { text += chunk.toString('latin1'); }).on('error', () => {});
  await new Promise((done) => setTimeout(done, 2000 * kPatience));
  response.destroy();
  return text.split('Content-Type: image/jpeg').length - 1;
}

/** The status of a WebSocket's handshake, and "hello" if that is the first it says. */
async function shakeHands(url, origin, path = 'api/ws') {
  const headers = { Origin: origin, Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13',
    'Sec-WebSocket-Key': 'dGhlIHNhbXBsZSBub25jZQ==' };
  const { status, socket, first } = await ask(url, path, { headers });
  if (status !== 101) return { status };
  let text = first.toString('latin1');
  socket.on('data', (chunk) => { text += chunk.toString('latin1'); }).on('error', () => {});
  for (let i = 0; i < 100 * kPatience && !text.includes('"state"'); ++i) await new Promise((done) => setTimeout(done, 50));
  socket.destroy();
  return { status, said: text.match(/"hello"/)?.[0], live: text.includes('"state"') };
}

/** Page, state, pictures, socket and commands through the proxy at `url`, and nothing of that for pages of others. */
export async function checkAll(url, token) {
  const { origin } = new URL(url);
  const page = await ask(url, `?token=${token}`);
  assert.equal(page.status, 200, 'the page');
  for (const [, path] of page.body.matchAll(/(?:href|src)="([^"]+)"/g)) assert.equal((await ask(url, path)).status, 200, path);
  assert.equal((await ask(url, 'api/state')).status, 200, 'the state');
  const arrived = await pictures(url);
  assert.ok(arrived >= 5, `${arrived} pictures`);
  assert.deepEqual(await shakeHands(url, origin), { status: 101, said: '"hello"', live: true });
  const give = async (from, shown, name = 'hold') => {
    const headers = { Origin: from, 'Content-Length': 0, ...(shown ? { Authorization: `Bearer ${shown}` } : {}) };
    return (await ask(url, `api/${name}`, { method: 'POST', headers })).status;
  };
  assert.equal(await give(origin, token), 200, 'hold');
  assert.equal(await give(origin, token, 'resume'), 200, 'resume');
  assert.equal(await give(origin, ''), 401, 'hold without the token');
  assert.equal((await ask(url, `api/hold?token=${token}`)).status, 405, 'hold by a link');
  const others = ['https://evil.example', 'null', origin.replace(/:\d+$/, ':9'), origin.replace(/^https?/, (scheme) => (scheme === 'http' ? 'https' : 'http'))];
  for (const other of others) {
    assert.equal(await give(other, token), 403, `hold from ${other}`);
    assert.equal((await shakeHands(url, other)).status, 403, `a socket from ${other}`);
  }
}
