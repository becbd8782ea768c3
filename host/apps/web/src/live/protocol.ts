// What the page and the gateway say to each other (docs/reference/console-protocol.md).
import type { Layout } from '../data/record';
import type { Facts, LianaEvent } from '../data/sample';
import type { Robot, Scene } from '../model/robot';

export const SUBPROTOCOL = 'liana-console-1';
export const PROTOCOL = 1;

export type Role = 'watch' | 'operate' | 'administer';

export interface Welcome {
  op: 'welcome';
  protocol: number;
  role: Role;
  name: string;
  robot: Robot;
  scene: Scene;
  period_s: number;
  interval_ticks: number;
  time_mode: string;
  layout: Layout;
  ticket?: string; // for recorded runs, where tokens are asked for
  practice?: boolean; // the arm is simulated, and faults can be let happen
}

export interface Answer {
  op: 'answer';
  id?: number;
  ok: boolean;
  answer?: Record<string, unknown>;
  code?: string;
  message?: string;
}

// A way that the planner has found; it begins where the arm was commanded to be.
export interface PlannedWay {
  from_deg: number[];
  points_deg: number[][];
  duration_s: number;
  min_clearance_m: number | null; // null: nothing is in the scene
  nearest: string;
}

// A fault of the simulated arm that is on.
export interface FaultOn {
  kind: string;
  drives: number[]; // from 1
  can_end: boolean;
}

export type FromPlanner = { op: 'plan'; number: number } & ({ phase: 'planning'; for_s: number; text: string } | { phase: 'none'; text: string } | ({ phase: 'found' } & PlannedWay));

export type FromGateway =
  | { op: 'challenge'; nonce: string; loopback: boolean; proof?: boolean }
  | Welcome
  | { op: 'away'; text: string }
  | { op: 'facts'; facts: number; state: Facts }
  | ({ op: 'event' } & LianaEvent)
  | { op: 'events_lost'; from: number; to: number; count: number }
  | FromPlanner
  | Answer;

export interface Token {
  name: string;
  secret: string;
}

function hex(bytes: ArrayBuffer): string {
  return [...new Uint8Array(bytes)].map((b) => b.toString(16).padStart(2, '0')).join('');
}

// HMAC-SHA256 of the nonce's text by the token's secret, in hex: the secret itself never crosses the wire.
export async function proofOf(secret: string, nonce: string): Promise<string> {
  const text = new TextEncoder();
  const key = await crypto.subtle.importKey('raw', text.encode(secret), { name: 'HMAC', hash: 'SHA-256' }, false, ['sign']);
  return hex(await crypto.subtle.sign('HMAC', key, text.encode(nonce)));
}

// The answer to a record: its credit comes back.
export function creditOf(sequence: number): ArrayBuffer {
  const bytes = new ArrayBuffer(4);
  new DataView(bytes).setUint32(0, sequence, true);
  return bytes;
}
