// Where the server is: below the folder of the page, which a proxy may have put anywhere. All paths are relative to it.

/** The path of the page without its file: "/swiftlet/". */
export function folder() {
  return new URL('.', location.href).pathname;
}

/** The address of a WebSocket with that path: by TLS where the page came by it. */
export function socketUrl(path) {
  const url = new URL(path, location.href);
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}
