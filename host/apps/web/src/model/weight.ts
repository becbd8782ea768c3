// How much an event matters.
import type { LianaEvent } from '../data/sample';
import { TROUBLE } from '../data/derived_events';

export type Weight = 'bad' | 'warning' | 'note';

const BAD = new Set(['fault', 'stop', 'boot_problem']);
const WARNING = new Set(['verdict', 'refusal', 'host_warning', 'emergency', 'left_out']);
const DERIVED = new Set(['push', 'wrist', 'adapter', 'servo']);

export function weightOf(event: LianaEvent): Weight {
  if (BAD.has(event.kind)) return 'bad';
  if (WARNING.has(event.kind)) return 'warning';
  if (DERIVED.has(event.kind) && event.number === TROUBLE) return 'warning';
  if (event.kind === 'path' && event.number === 0) return 'warning';
  if (event.kind === 'friction' && event.number !== 0) return 'warning';
  if (event.kind === 'device' && event.number === 1) return 'warning';
  if (event.kind === 'boot' && event.number === 0) return 'bad';
  if (event.kind === 'homing' && event.number === 0) return 'bad';
  if (event.kind === 'owner' && event.number > 2) return 'warning';
  if (event.kind === 'clear' && event.number !== 0) return 'warning';
  return 'note';
}
