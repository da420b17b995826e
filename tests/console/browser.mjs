// Chromium and playwright-core for the browser tests; exit code 77 (skipped) if they are not installed.
import { execFileSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const kHere = dirname(fileURLToPath(import.meta.url));

/** How many times slower than a release build this one may be; ctest sets it. */
export const kPatience = Number(process.env.SWIFTLET_TEST_PATIENCE ?? 1);

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** playwright-core is installed below the build folder, once. */
function playwright(folder) {
  if (!existsSync(join(folder, 'node_modules', 'playwright-core'))) {
    mkdirSync(folder, { recursive: true });
    cpSync(join(kHere, 'package.json'), join(folder, 'package.json'));
    try {
      execFileSync('npm', ['install', '--no-audit', '--no-fund', '--loglevel=error'], { cwd: folder, stdio: 'inherit', timeout: 120_000 });
    } catch {
      skip('npm could not install playwright-core');
    }
  }
  return createRequire(resolve(folder, 'index.js'))('playwright-core');
}

export async function launch(folder) {
  const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
  if (!executablePath) skip('there is no chromium; apt-get install chromium');
  return playwright(folder).chromium.launch({ executablePath, args: ['--no-sandbox'] });
}
