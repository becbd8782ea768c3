// What faults and refusals mean and what to do, from the code's own tables (docs/reference/faults.md,
// docs/reference/refusals.md).
import tables from 'liana:tables';

export interface FaultRow {
  number: number;
  name: string;
  retract: boolean; // is let through while it is latched
  text: string;
  remedy: string;
}

export interface RefusalRow {
  number: number; // refusal code
  name: string;
  text: string;
  action: string; // what lianad does besides: hold or stop
  remedy: string;
}

const faults = new Map((tables.faults as FaultRow[]).map((row) => [row.number, row]));
const refusals = new Map((tables.refusals as RefusalRow[]).map((row) => [row.number, row]));

export function faultRow(number: number): FaultRow | undefined {
  return faults.get(number);
}

export function refusalRow(number: number): RefusalRow | undefined {
  return refusals.get(number);
}
