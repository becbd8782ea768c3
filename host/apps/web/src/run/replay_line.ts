// Says how many of a run's ticks came out the same when this browser ran the controller on them again.
import type { ReplayHead, RunHead } from '../data/run';
import { h, setText } from '../ui/dom';
import { replayIn, type Replay } from './replay';

const SLICE_TICKS = 100; // some milliseconds
const MIN_IDLE_MS = 4;

const count = (ticks: number) => ticks.toLocaleString('en');

function sentence(head: ReplayHead, replay: Replay): string {
  const { done, differing, firstDiffering } = replay.state;
  if (done < head.ticks) return `replaying in this browser: ${count(done)} of ${count(head.ticks)} ticks`;
  const rest = head.recorded > head.ticks ? `; the run had ${count(head.recorded)}, this page holds the first` : '';
  const same = `${count(done - differing)} of ${count(done)} ticks identical${rest}`;
  return firstDiffering === null ? same : `${same}; the first other one is number ${count(firstDiffering + 1)}`;
}

// Replays while the browser has nothing else to do.
export function replayLine(head: RunHead): HTMLElement | null {
  const { replay: ofRun } = head;
  if (!ofRun) return null;
  const line = h('p', { class: 'replay', title: 'The controller that ticked in this run, in this browser once more, on the recorded inputs' });
  const fail = (error: unknown) => setText(line, `the ticks cannot be replayed here: ${String(error)}`);
  const begin = (replay: Replay) => {
    const slice = (idle?: IdleDeadline) => {
      try {
        let goesOn = replay.run(SLICE_TICKS);
        while (goesOn && idle && idle.timeRemaining() > MIN_IDLE_MS) goesOn = replay.run(SLICE_TICKS);
        setText(line, sentence(ofRun, replay));
        if (goesOn) later(slice);
      } catch (error) {
        fail(error);
      }
    };
    later(slice);
  };
  replayIn(document, ofRun).then((replay) => replay && begin(replay), fail);
  return line;
}

function later(slice: (idle?: IdleDeadline) => void): void {
  if ('requestIdleCallback' in window) requestIdleCallback(slice);
  else setTimeout(slice, 20);
}
