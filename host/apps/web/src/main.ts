// The page begins here: a run that is in it is shown; else it is the console.
import { runIn } from './data/run';
import { LivePage } from './live/live_page';
import { useSoftwareCanvas } from './plots/strip';
import { RunPage } from './run/run_page';
import { h } from './ui/dom';
import { apply, themeNow } from './ui/theme';

async function begin(): Promise<void> {
  const place = document.getElementById('page')!;
  try {
    apply(themeNow());
    useSoftwareCanvas();
    const run = await runIn(document);
    if (!run) {
      const page = new LivePage(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`);
      place.append(page.element);
      Object.assign(window, { liana: page }); // for measurements and the browser's console
    } else {
      document.title = `${run.head.title} \u2013 Liana`;
      place.append(new RunPage(run).element);
    }
  } catch (error) {
    place.append(h('p', { role: 'alert' }, `This page cannot be shown: ${String(error)}`));
  }
  place.removeAttribute('aria-busy');
}

if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', () => void begin());
else void begin();
