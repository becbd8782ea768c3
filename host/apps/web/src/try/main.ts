// The page to try Liana begins here: program and tables are in it.
import { inflated } from '../data/telemetry';
import { h } from '../ui/dom';
import { apply, themeNow } from '../ui/theme';
import { TryArm } from './try_arm';
import { TryPage } from './try_page';

async function begin(): Promise<void> {
  const place = document.getElementById('page')!;
  const textOf = (id: string) => document.getElementById(id)!.textContent!;
  try {
    apply(themeNow());
    const tables = textOf('liana-tables');
    const [, robot, scene] = tables.split('\n').map((line) => JSON.parse(line || 'null'));
    const page = new TryPage(await TryArm.of(await inflated(textOf('liana-try')), tables), robot, scene);
    place.append(page.element);
    Object.assign(window, { liana: page }); // for the browser's console
  } catch (error) {
    place.append(h('p', { role: 'alert' }, `This page cannot be shown: ${String(error)}`));
  }
  place.removeAttribute('aria-busy');
}

void begin();
