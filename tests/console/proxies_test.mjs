// The page through proxies that are made here, without a browser: node proxies_test.mjs WEB_FIXTURE WORK_FOLDER
import { run, serve } from './browser.mjs';
import { certificate, checkAll, startProxy } from './proxies.mjs';

const [fixture, folder] = process.argv.slice(2);
const tls = certificate(folder);
const kToken = 'operator-token';

/** Starts proxy and fixture, with the address that `url(port)` gives for the proxy's port, and checks all through it. */
async function through({ path = '/', url, options = [], ...kind }) {
  const routes = { [path]: 0 };
  const proxy = await startProxy({ ...kind, routes });
  const outside = url(proxy.port);
  const server = await serve(fixture, 0, kToken, 'plain', outside, ...options);
  routes[path] = Number(server.url.port);
  try {
    await checkAll(outside, kToken);
  } finally {
    proxy.close();
    await server.stop();
  }
}

const passesOn = (header) => /^(host|connection|upgrade):/i.test(header);

const failed = await run({
  'TLS in front, HTTP/1.0 and another Host behind': () =>
    through({ tls, url: (port) => `https://field.example:${port}/` }),
  'below a path that is taken off': () =>
    through({ tls, path: '/swiftlet/', url: (port) => `https://field.example:${port}/swiftlet/` }),
  'below a path that is left on': () =>
    through({ tls, path: '/a/swiftlet/', strips: false, url: (port) => `https://field.example:${port}/a/swiftlet/` }),
  'without TLS, by HTTP/1.0': () => through({ url: (port) => `http://127.0.0.1:${port}/` }),
  'by HTTP/1.1 with the Host, and sockets': () =>
    through({ tls, path: '/swiftlet/', version: '1.1', keeps: passesOn, url: (port) => `https://field.example:${port}/swiftlet/` }),
  'one public address of several': () =>
    through({ tls, url: (port) => `https://field.example:${port}/`, options: ['http://drone.local:8080', 'https://other.example/'] }),
});
process.exit(failed ? 1 : 0);
