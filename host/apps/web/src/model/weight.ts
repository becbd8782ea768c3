// How much an event matters.
import type { LianaEvent } from '../data/sample';
import { kTrouble } from '../data/derived_events';

export type Weight = 'bad' | 'warning' | 'note';

const kBad = new Set(['fault', 'stop', 'boot_problem']);
const kWarning = new Set(['verdict', 'refusal', 'host_trouble', 'emergency', 'left_out']);
const kTold = new Set(['push', 'wrist', 'adapter', 'servo']);

export function weight_of(event: LianaEvent): Weight {
  if (kBad.has(event.kind)) return 'bad';
  if (kWarning.has(event.kind)) return 'warning';
  if (kTold.has(event.kind) && event.number === kTrouble) return 'warning';
  if (event.kind === 'path' && event.number === 0) return 'warning';
  if (event.kind === 'friction' && event.number !== 0) return 'warning';
  if (event.kind === 'device' && event.number === 1) return 'warning';
  if (event.kind === 'boot' && event.number === 0) return 'bad';
  if (event.kind === 'homing' && event.number === 0) return 'bad';
  if (event.kind === 'owner' && event.number > 2) return 'warning';
  if (event.kind === 'clear' && event.number !== 0) return 'warning';
  return 'note';
}
