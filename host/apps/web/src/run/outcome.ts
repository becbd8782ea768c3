// Of a run that did not succeed: what failed, where, why, and what to do; of one that did, its figures.
import type { Command, RunHead } from '../data/run';
import { last_before } from '../data/run';
import type { LianaEvent } from '../data/sample';
import { length_text } from '../model/sentence';
import { fault_row, refusal_row } from '../model/tables';

export interface Outcome {
  success: boolean;
  what: string;
  where: string;
  why: string;
  todo: string[];
  tick: number | null; // the moment to look at
}

const kNoticed_s = 0.5; // between a fault and what the mission says of it, at most

function where_of(head: RunHead, tick: number): string {
  const step = head.steps[last_before(head.steps, tick)];
  const at = `at ${(tick * head.period_s).toFixed(1)} s`;
  return step ? `${at}, in step ${step.index}: ${step.name}` : at;
}

// Drives count from 0, in the order of the cables; on the bus they are nodes, which count from 1
// (docs/reference/drives.md).
function where_it_is(subject: string, robot: RunHead['robot']): string {
  const drive = /^drive (\d+)$/.exec(subject);
  if (!drive) return subject;
  const index = Number(drive[1]);
  const segments = robot.kind === 'serial' ? [] : robot.cables.phase_deg.flatMap((cables, segment) => cables.map(() => segment + 1));
  return `${subject} (node ${index + 1}${segments[index] ? `, segment ${segments[index]}` : ''})`;
}

// When the step that failed was over; null: no step did. What came later followed from it.
function end_of_step(head: RunHead, name: string | undefined, duration_s: number): number | null {
  const begun = head.steps.filter((step) => step.name === name).pop();
  return begun ? begun.tick + Math.round(duration_s / head.period_s) : null;
}

// The event that ended it: the first fault or stop; else the last thing that was refused until then.
function cause_of(events: readonly LianaEvent[], until: number): LianaEvent | undefined {
  const before = events.filter((e) => e.tick <= until);
  const hard = before.find((e) => e.kind === 'fault' || e.kind === 'boot_problem' || e.kind === 'stop');
  if (hard) return hard;
  const refused = before.filter((e) => e.kind === 'verdict' || (e.kind === 'path' && e.number === 0) || e.kind === 'refusal');
  return refused[refused.length - 1];
}

function remedy_of(event: LianaEvent, commands: readonly Command[]): string | undefined {
  if (event.kind === 'fault' || event.kind === 'boot_problem') return fault_row(event.number)?.remedy;
  if (event.kind === 'verdict') {
    const refusal = commands.find((c) => c.command === event.values.command)?.refusal;
    return refusal?.remedy || refusal_row(event.number)?.remedy;
  }
  if (event.kind === 'path') return refusal_row(207)?.remedy;
  if (event.kind === 'stop') return 'Find out why it was stopped; then liana clear, enable, and retract or begin anew.';
  return undefined;
}

// Letters and figures alone: the same reason comes in several spellings ("move_cp refused (busy): x", "move_cp refused: busy: x").
function words_of(text: string): string {
  return text.toLowerCase().match(/[\p{L}\p{N}.]+/gu)?.join(' ') ?? '';
}

// "the arm is FAULT (stop category off), faults: 5006 cable_break 7": what the mission saw of a fault or stop. Says it more
// than the event that ended the run does?
function says_more(reason: string, cause: LianaEvent | undefined): boolean {
  const seen = /the arm is [A-Z]+ \(stop category \w+\), faults: (.+)$/.exec(reason);
  if (!seen || !cause) return true;
  return seen[1].split(', ').some((fault) => fault !== 'none named' && !fault.startsWith(`${cause.number} `));
}

// The event that ended it, then what else report and step say; nothing is said twice, and what to do not here.
function why_of(cause: LianaEvent | undefined, robot: RunHead['robot'], reasons: readonly string[], todo: readonly string[]): string {
  const subject = cause ? where_it_is(cause.subject, robot) : '';
  const is_named = !cause || subject === '' || words_of(cause.text).includes(words_of(subject));
  const text = todo.reduce((rest, remedy) => rest.replace(`${remedy} `, ''), cause?.text ?? '');
  const first = cause ? `${is_named ? '' : `${subject}: `}${text}` : '';
  const more: string[] = [];
  for (const reason of reasons.flatMap((text) => text.split('; '))) {
    if (says_more(reason, cause) && ![first, ...more].some((said) => words_of(said).includes(words_of(reason)))) more.push(reason);
  }
  return [first, more.join('; ')].filter((text) => text !== '').join(' \u2013 ');
}

export function outcome_of(head: RunHead): Outcome {
  const report = head.report ?? {};
  if (!head.report) {
    return { success: false, what: 'The run left no report', where: '', why: 'It was interrupted, or is still going on.', todo: ['Look at the last events.'], tick: null };
  }
  if (report.outcome === 'success') {
    const parts = [`${(report.duration_s ?? 0).toFixed(1)} s`];
    const clear = (report.verified_clearance_m as { min?: number } | undefined)?.min ?? (report.min_clearance_m as number | undefined);
    if (typeof clear === 'number' && clear < 100) parts.push(`at least ${length_text(clear)} clear of everything`);
    if (typeof report.tip_error_m === 'number') parts.push(`tip ${length_text(report.tip_error_m)} from its goal in the end`);
    return { success: true, what: `Success: ${parts.join(', ')}`, where: '', why: '', todo: [], tick: null };
  }
  return failure_of(head);
}

function failure_of(head: RunHead): Outcome {
  const report = head.report!;
  const failed = report.steps?.find((step) => step.outcome !== 'success');
  const end = failed ? end_of_step(head, failed.name, failed.duration_s) : null;
  const cause = cause_of(head.events, end === null ? Infinity : end + kNoticed_s / head.period_s);
  const tick = cause?.tick ?? end;
  const todo = new Set<string>();
  for (const fault of report.faults ?? []) todo.add(fault.remedy ?? fault_row(fault.number)?.remedy ?? '');
  if (cause) todo.add(remedy_of(cause, head.commands) ?? '');
  todo.delete('');
  for (const criterion of todo.size === 0 && !failed ? report.criteria ?? [] : []) {
    if (!criterion.met) todo.add(`${criterion.name.replaceAll('_', ' ')} is ${Number(criterion.value.toPrecision(4))}, its limit is ${criterion.limit}: look at where that was.`);
  }
  if (todo.size === 0) todo.add('Look at that moment: what the step still waited for stands above, what the arm did in plots and events.');
  return {
    success: false,
    what: `${report.mission ?? head.title} ${report.outcome ?? 'failed'}${failed ? ` in "${failed.name}"` : ''}`,
    where: tick === null ? '' : where_of(head, tick),
    why: why_of(cause, head.robot, [report.reason ?? '', failed?.reason ?? ''], [...todo]),
    todo: [...todo],
    tick,
  };
}
