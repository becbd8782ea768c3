// What to do next on the way through the slit, in one line.
import { value, values } from '../data/sample';
import type { TrySample } from './try_arm';
import { lengthText } from '../model/text';
import type { Way } from './way';

const AT_ROD_M = 0.012; // the tip touches it, 10 mm thick, with what the arm's command may be off
const OFF_WAY_M = 0.15;
const SOON_M = 0.15;

export type Weight = 'todo' | 'wait' | 'warning' | 'done';

export interface Hint {
  weight: Weight;
  text: string;
}

const hint = (weight: Weight, text: string): Hint => ({ weight, text });

// Of an arm that is enabled.
function onTheWay(sample: TrySample, way: Way): Hint {
  const { verdict, planar_segments, held_at_target } = sample.facts;
  if (verdict.code !== 0) return hint('warning', `Refused [${verdict.code}]: ${verdict.text}. The arm has stopped. Steer another way.`);
  const tip = values(sample, 'setpoint_cp');
  const { s_m, off_m } = way.nearestTo(tip);
  if (way.length_m - s_m < AT_ROD_M && off_m < AT_ROD_M) return hint('done', 'The tip is at the press rod: you have crossed the slit. Lead the arm back, or begin anew.');
  if (planar_segments && held_at_target === false) {
    const which = planar_segments === 1 ? 'Segment 5 turns' : 'Segments 4 and 5 turn';
    return hint('wait', `${which} into the plane of the slit; the tip waits. Go on holding.`);
  }
  if (off_m > OFF_WAY_M) return hint('todo', 'Lead the tip back to the line; it is the way into the slit.');
  const clear = lengthText(value(sample, 'clearance.distance_m'));
  if (s_m > way.mouth_m) return hint('todo', `Inside the slit, ${clear} clear: go on to the rod, ${lengthText(way.length_m - s_m)} from here.`);
  if (s_m > way.mouth_m - SOON_M) return hint('todo', 'Go in along the line. The arm slows down by itself.');
  return hint('todo', 'Drag the ball at the tip along the line, towards the slit.');
}

export function hintOf(sample: TrySample, way: Way): Hint {
  switch (sample.facts.state) {
    case 'DISABLED': return hint('todo', 'Press enable: the brakes open and the cables are tightened.');
    case 'ENABLING': return hint('wait', 'The cables are being tightened, for about 3 s.');
    case 'STOPPING': return hint('wait', 'The arm comes to rest, then the brakes close.');
    case 'FAULT': return hint('warning', 'A fault has stopped the arm. Press clear, then enable.');
    default: return onTheWay(sample, way);
  }
}
