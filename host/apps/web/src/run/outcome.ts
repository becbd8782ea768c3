// Of a run that did not succeed: what failed, where, why, and what to do; of one that did, its figures.
import type { Command, RunHead } from '../data/run';
import { lastBefore } from '../data/run';
import type { LianaEvent } from '../data/sample';
import { PATH_REFUSED } from '../model/outcome_text';
import { lengthText, spoken } from '../model/text';
import { faultRow, refusalRow } from '../model/tables';

export interface Outcome {
  success: boolean;
  what: string;
  where: string;
  why: string;
  todo: string[];
  tick: number | null; // the moment to look at
}

const NOTICED_S = 0.5; // between a fault and what the mission says of it, at most

function whereOf(head: RunHead, tick: number): string {
  const step = head.steps[lastBefore(head.steps, tick)];
  const at = `at ${(tick * head.period_s).toFixed(1)} s`;
  return step ? `${at}, in step ${step.index}: ${step.name}` : at;
}

// When the step that failed was over; null: no step did. What came later followed from it.
function endOfStep(head: RunHead, name: string | undefined, duration_s: number): number | null {
  const begun = head.steps.filter((step) => step.name === name).pop();
  return begun ? begun.tick + Math.round(duration_s / head.period_s) : null;
}

// The event that ended it: the first fault or stop; else the last thing that was refused until then.
function causeOf(events: readonly LianaEvent[], until: number): LianaEvent | undefined {
  const before = events.filter((e) => e.tick <= until);
  const hard = before.find((e) => e.kind === 'fault' || e.kind === 'boot_problem' || e.kind === 'stop');
  if (hard) return hard;
  const refused = before.filter((e) => e.kind === 'verdict' || (e.kind === 'path' && e.number === 0) || e.kind === 'refusal');
  return refused[refused.length - 1];
}

function remedyOf(event: LianaEvent, commands: readonly Command[]): string | undefined {
  if (event.kind === 'fault' || event.kind === 'boot_problem') return faultRow(event.number)?.remedy;
  if (event.kind === 'verdict') {
    const refusal = commands.find((c) => c.command === event.values.command)?.refusal;
    return refusal?.remedy || refusalRow(event.number)?.remedy;
  }
  if (event.kind === 'path') return refusalRow(PATH_REFUSED)?.remedy;
  if (event.kind === 'stop') return 'Find out why it was stopped; then liana clear, enable, and retract or begin anew.';
  return undefined;
}

// Letters and figures alone: the same reason comes in several spellings ("move_cp refused (busy): x", "move_cp refused: busy: x").
function comparableText(text: string): string {
  return text.toLowerCase().match(/[\p{L}\p{N}.]+/gu)?.join(' ') ?? '';
}

// "the arm is FAULT (stop category off), faults: 5006 cable_break: drive 8 (node 8, segment 3)": what the mission saw of a fault or stop. Says it more
// than the event that ended the run does?
function saysMore(reason: string, cause: LianaEvent | undefined): boolean {
  const seen = /the arm is [A-Z]+ \(stop category \w+\), faults: (.+)$/.exec(reason);
  if (!seen || !cause) return true;
  return seen[1].split(/, (?=\d{4} )/).some((fault) => fault !== 'none named' && !fault.startsWith(`${cause.number} `));
}

// The event that ended it, then what else report and step say; nothing is said twice, and what to do not here.
function whyOf(cause: LianaEvent | undefined, reasons: readonly string[], todo: readonly string[]): string {
  const subject = cause?.subject ?? '';
  const isNamed = !cause || subject === '' || comparableText(cause.text).includes(comparableText(subject));
  const text = todo.reduce((rest, remedy) => rest.replace(`${remedy} `, ''), cause?.text ?? '');
  const first = cause ? `${isNamed ? '' : `${subject}: `}${text}` : '';
  const more: string[] = [];
  for (const reason of reasons.flatMap((text) => text.split('; '))) {
    if (saysMore(reason, cause) && ![first, ...more].some((said) => comparableText(said).includes(comparableText(reason)))) more.push(reason);
  }
  return [first, more.join('; ')].filter((text) => text !== '').join(' \u2013 ');
}

export function outcomeOf(head: RunHead): Outcome {
  const report = head.report ?? {};
  if (!head.report) {
    return { success: false, what: 'The run left no report', where: '', why: 'It was interrupted, or is still going on.', todo: ['Look at the last events.'], tick: null };
  }
  if (report.outcome === 'success') {
    const parts = [`${(report.duration_s ?? 0).toFixed(1)} s`];
    const clear = (report.verified_clearance_m as { min?: number } | undefined)?.min ?? (report.min_clearance_m as number | undefined);
    if (typeof clear === 'number' && clear < 100) parts.push(`at least ${lengthText(clear)} clear of everything`);
    if (typeof report.tip_error_m === 'number') parts.push(`tip ${lengthText(report.tip_error_m)} from its goal in the end`);
    return { success: true, what: `Success: ${parts.join(', ')}`, where: '', why: '', todo: [], tick: null };
  }
  return failureOf(head);
}

function failureOf(head: RunHead): Outcome {
  const report = head.report!;
  const failed = report.steps?.find((step) => step.outcome !== 'success');
  const end = failed ? endOfStep(head, failed.name, failed.duration_s) : null;
  const cause = causeOf(head.events, end === null ? Infinity : end + NOTICED_S / head.period_s);
  const tick = cause?.tick ?? end;
  const todo = new Set<string>();
  for (const fault of report.faults ?? []) todo.add(fault.remedy ?? faultRow(fault.number)?.remedy ?? '');
  if (cause) todo.add(remedyOf(cause, head.commands) ?? '');
  todo.delete('');
  for (const criterion of todo.size === 0 && !failed ? report.criteria ?? [] : []) {
    if (!criterion.met) todo.add(`${spoken(criterion.name)} is ${Number(criterion.value.toPrecision(4))}, its limit is ${criterion.limit}: look at where that was.`);
  }
  if (todo.size === 0) todo.add('Look at that moment: what the step still waited for stands above, what the arm did in plots and events.');
  return {
    success: false,
    what: `${report.mission ?? head.title} ${report.outcome ?? 'failed'}${failed ? ` in "${failed.name}"` : ''}`,
    where: tick === null ? '' : whereOf(head, tick),
    why: whyOf(cause, [report.reason ?? '', failed?.reason ?? ''], [...todo]),
    todo: [...todo],
    tick,
  };
}
