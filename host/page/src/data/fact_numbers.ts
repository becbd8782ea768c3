// Numbers that a state has among its facts (docs/api.md): what the wrist feels, a push, the servo. With them as fields
// beside those of a record, strips and tables need not know where a number comes from.
import type { Facts } from './sample';

export interface FactField {
  name: string;
  unit: string;
  count: number;
  of(facts: Facts): readonly number[] | null | undefined; // nothing: not there now
}

const wrist = ({ push }: Facts) => (push && push.wrist_age_s !== null ? push : null);
const push = ({ push }: Facts) => (push && push.number > 0 ? push : null);
const adapter = ({ adapter }: Facts) => (adapter && adapter.age_s !== null ? adapter : null);
const servo = ({ servo }: Facts) => (servo && ['approaching', 'dwelling'].includes(servo.phase) ? servo : null);
const one = (number: number | undefined) => (number === undefined ? null : [number]);

export const kFactFields: readonly FactField[] = [
  { name: 'push.felt.force_N', unit: 'N', count: 3, of: (facts) => wrist(facts)?.felt.force_N },
  { name: 'push.felt.torque_Nm', unit: 'Nm', count: 3, of: (facts) => wrist(facts)?.felt.torque_Nm },
  { name: 'push.given.force_N', unit: 'N', count: 3, of: (facts) => push(facts)?.given.force_N },
  { name: 'push.set_N', unit: 'N', count: 1, of: (facts) => one(push(facts)?.set_N) },
  { name: 'push.travel_m', unit: 'm', count: 1, of: (facts) => one(push(facts)?.travel_m) },
  { name: 'push.aside_m', unit: 'm', count: 1, of: (facts) => one(push(facts)?.aside_m) },
  { name: 'adapter.depth_m', unit: 'm', count: 3, of: (facts) => adapter(facts)?.depth_m },
  { name: 'servo.error_m', unit: 'm', count: 3, of: (facts) => servo(facts)?.error_m },
  { name: 'servo.error_deg', unit: 'deg', count: 3, of: (facts) => servo(facts)?.error_deg },
];

// Puts the numbers of these facts into `numbers`, which has all of kFactFields.
export function read_fact_numbers(facts: Facts, numbers: ReadonlyMap<string, Float32Array>): void {
  for (const field of kFactFields) {
    const to = numbers.get(field.name)!;
    const from = field.of(facts);
    for (let i = 0; i < field.count; ++i) to[i] = from?.[i] ?? NaN;
  }
}

// Columns over time of those that are ever there: `facts_at` tells the facts of each row.
export function fact_columns(rows: number, facts_at: (row: number) => Facts): Map<string, Float32Array[]> {
  const empty = () => new Float32Array(rows).fill(NaN);
  const columns = new Map(kFactFields.map(({ name, count }) => [name, Array.from({ length: count }, empty)]));
  const known = new Set<string>();
  for (let row = 0; row < rows; ++row) {
    const facts = facts_at(row);
    for (const field of kFactFields) {
      const from = field.of(facts);
      if (!from) continue;
      known.add(field.name);
      columns.get(field.name)!.forEach((column, i) => (column[row] = from[i] ?? NaN));
    }
  }
  for (const name of columns.keys()) if (!known.has(name)) columns.delete(name);
  return columns;
}
