// Numbers as a table for spreadsheets.
import type { Run } from './run';

function cell(text: string): string {
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

// One line for each row of the run between two arm times, a column for each field and index, from 1; numbers that are not there
// stay empty.
export function csvOf(run: Run, from_s: number, to_s: number): string {
  const { columns } = run.head.telemetry;
  const isList = (name: string) => columns.filter((c) => c.name === name).length > 1;
  const names = columns.map((c) => cell(`${c.name}${isList(c.name) ? `_${c.index + 1}` : ''} [${c.unit}]`));
  const lines = [['tick', 'time_s [s]', ...names].join(',')];
  for (let row = run.rowAt(from_s); row <= run.rowAt(to_s); ++row) {
    const numbers = columns.map((c) => {
      const value = run.telemetry.columns.get(c.name)![c.index][row];
      return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : '';
    });
    lines.push([run.tick(row), run.time_s(row).toFixed(3), ...numbers].join(','));
  }
  return lines.join('\n') + '\n';
}

// Lets the person keep a text as a file.
export function saveAs(name: string, text: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}
