// The page through nginx, by the lines of docs/tutorials/operator.md and by those that others wrote; skipped without nginx.
// node nginx_test.mjs WEB_FIXTURE WORK_FOLDER
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { connect, createServer } from 'node:net';
import { join, resolve } from 'node:path';

import { eventually, run, serve, skip } from './browser.mjs';
import { certificate, checkAll } from './proxies.mjs';

const [fixture, work] = process.argv.slice(2);
const nginx = [...process.env.PATH.split(':'), '/usr/sbin'].map((folder) => join(folder, 'nginx')).find(existsSync);
if (!nginx) skip('there is no nginx; apt-get install nginx-light (which starts a server at port 80)');
const folder = resolve(work, 'nginx');
mkdirSync(folder, { recursive: true });
const { cert, key } = certificate(folder);
const kToken = 'operator-token';

async function freePort() {
  const listener = createServer();
  await new Promise((done) => listener.listen(0, '127.0.0.1', done));
  const { port } = listener.address();
  await new Promise((done) => listener.close(done));
  return port;
}

const listens = (port) => new Promise((done) => {
  const socket = connect(port, '127.0.0.1', () => { socket.destroy(); done(true); }).on('error', () => done(false));
});

/** Starts nginx with these servers, one of which listens at `port`; the result stops it. */
async function startNginx(servers, port) {
  const temporary = ['client_body', 'proxy', 'fastcgi', 'uwsgi', 'scgi'].map((name) => `${name}_temp_path ${folder}/${name};`).join(' ');
  writeFileSync(join(folder, 'nginx.conf'), `daemon off; pid ${folder}/pid; error_log ${folder}/error.log; worker_processes 1;
events {}
http { access_log off; ${temporary}
${servers}
}
`);
  const child = spawn(nginx, ['-p', folder, '-c', join(folder, 'nginx.conf'), '-e', join(folder, 'error.log')], { stdio: 'inherit' });
  await eventually('nginx', () => listens(port), 10);
  return () => new Promise((done) => child.once('exit', done).kill());
}

/** Checks all through the server that `serversOf(outer port, inner port)` describes; `more` are public addresses too. */
async function through(urlOf, serversOf, ...more) {
  const outer = await freePort();
  const url = urlOf(outer);
  const server = await serve(fixture, 0, kToken, 'plain', url, ...more);
  const stop = await startNginx(serversOf(outer, server.url.port), outer);
  try {
    await checkAll(url, kToken);
  } finally {
    await stop();
    await server.stop();
  }
}

/** The block of the page, on other ports and with another certificate. */
function linesOfTheTutorial(outer, inner) {
  const block = readFileSync('docs/tutorials/operator.md', 'utf8').match(/```nginx[^\n]*\n([^`]*)```/)[1];
  return block.replaceAll('8080', inner).replace('listen 443', `listen 127.0.0.1:${outer}`)
    .replace(/ssl_certificate .*;/, `ssl_certificate ${cert};`).replace(/ssl_certificate_key .*;/, `ssl_certificate_key ${key};`);
}

const kPlain = { 'proxy_pass alone': 'location / { proxy_pass http://127.0.0.1:PORT; }',
  'a path that is left on': 'location /swiftlet { proxy_pass http://127.0.0.1:PORT; }',
  'a path that is taken off, all but its slash': 'location /swiftlet { proxy_pass http://127.0.0.1:PORT/; }',
  'HTTP/1.1 without a word of sockets': 'location /swiftlet/ { proxy_http_version 1.1; proxy_set_header Host $host; proxy_pass http://127.0.0.1:PORT/; }' };

const tests = {
  'the lines of the tutorial': () => through((port) => `https://field.example:${port}/swiftlet/`, linesOfTheTutorial),
};
for (const [name, location] of Object.entries(kPlain)) {
  const path = location.includes('/swiftlet') ? '/swiftlet/' : '/';
  tests[name] = () => through((port) => `http://field.example:${port}${path}`,
    (outer, inner) => `server { listen 127.0.0.1:${outer}; ${location.replace('PORT', inner)} }`);
  tests[`${name}, by TLS`] = () => through((port) => `https://field.example:${port}${path}`,
    (outer, inner) => `server { listen 127.0.0.1:${outer} ssl; ssl_certificate ${cert}; ssl_certificate_key ${key}; ${location.replace('PORT', inner)} }`);
}

tests['an upstream with a name, which is the Host'] = () => through((port) => `http://field.example:${port}/`, (outer, inner) =>
  `upstream swiftlet_app { server 127.0.0.1:${inner}; } server { listen 127.0.0.1:${outer}; location / { proxy_pass http://swiftlet_app; } }`,
'http://swiftlet_app/');

const kCase = join(process.env.SWIFTLET_DATASETS ?? '../shared/datasets', '10-field-cases/web_https_proxy/nginx.conf');
if (!existsSync(kCase)) console.log(`skipped: the servers of ${kCase}, which is not there; set SWIFTLET_DATASETS`);
else {
  for (const [, server, port] of readFileSync(kCase, 'utf8').matchAll(/^ (server \{ listen 127.0.0.1:(\d+).*)$/gm)) {
    const scheme = server.includes('ssl') ? 'https' : 'http', path = server.match(/location (\S+)/)[1];
    tests[`the server at ${port} of the field case`] = () => through((outer) => `${scheme}://127.0.0.1:${outer}${path}`,
      (outer, inner) => server.replace(port, outer).replace('18080', inner).replace('c.pem', cert).replace('k.pem', key));
  }
}

process.exit(await run(tests) ? 1 : 0);
