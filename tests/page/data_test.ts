import assert from 'node:assert/strict';
import { test } from 'node:test';
import { RecordReader, type Layout } from '../../host/apps/web/src/data/record';
import { lastBefore, Run, type RunHead } from '../../host/apps/web/src/data/run';
import { telemetryOf } from '../../host/apps/web/src/data/telemetry';
import { chainOf } from '../../host/apps/web/src/model/arm_chain';
import { crc32 } from '../../host/apps/web/src/run/replay';
import { decimated } from '../../host/apps/web/src/plots/decimate';
import { groupsOf } from '../../host/apps/web/src/plots/groups';
import { yRange } from '../../host/apps/web/src/plots/strip';
import { ARM, near } from './support';

const layout: Layout = {
  version: 1,
  bytes: 36,
  fields: [
    { name: 'measured_js_deg', unit: 'deg', offset: 24, count: 2 },
    { name: 'clearance.distance_m', unit: 'm', offset: 32, count: 1 },
  ],
};

function record(): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(36));
  view.setUint32(0, 7, true);
  view.setUint32(4, 3, true);
  view.setFloat64(8, 1e10, true);
  view.setFloat64(16, 4.5, true);
  [1.5, -2.5, NaN].forEach((value, i) => view.setFloat32(24 + 4 * i, value, true));
  return view.buffer;
}

test('a record is read at the places of its layout, little-endian', () => {
  const reader = new RecordReader(layout);
  assert.equal(reader.read(record()), true);
  assert.deepEqual([reader.sequence, reader.facts, reader.tick, reader.time_s], [7, 3, 1e10, 4.5]);
  assert.deepEqual([...reader.numbers.get('measured_js_deg')!], [1.5, -2.5]);
  assert.ok(Number.isNaN(reader.numbers.get('clearance.distance_m')![0]));
});

test('a record of another size changes nothing', () => {
  const reader = new RecordReader(layout);
  assert.equal(reader.read(new ArrayBuffer(32)), false);
  assert.equal(reader.sequence, 0);
});

test('a layout of another version, and one whose fields are not within the record, are refused by name', () => {
  assert.throws(() => new RecordReader({ ...layout, version: 2 }), /layout.version = 2/);
  const beyond = [{ name: 'x', unit: '1', offset: 32, count: 2 }];
  assert.throws(() => new RecordReader({ ...layout, fields: beyond }), /layout field x at 32/);
});

// As `liana view` writes them.
function planesOf(columns: number[][]): Uint8Array {
  const bytes: number[] = [];
  for (const column of columns) {
    const steps = column.map((value, i) => (value - (i > 0 ? column[i - 1] : 0)) & 0xffff);
    bytes.push(...steps.map((s) => s & 255), ...steps.map((s) => s >> 8));
  }
  return Uint8Array.from(bytes);
}

test('telemetry comes back from byte planes of differences, also across the end of int16', () => {
  const columns = [
    { name: 'a', index: 0, unit: 'm', scale: 0.5 },
    { name: 'a', index: 1, unit: 'm', scale: 1 },
  ];
  const head = { rows: 4, ticks: { first: 10, every: 5 }, columns };
  const telemetry = telemetryOf(head, planesOf([[1, -2, 32767, -32767], [-32768, 5, -32768, 0]]));
  assert.deepEqual([...telemetry.columns.get('a')![0]], [0.5, -1, 16383.5, -16383.5]);
  assert.deepEqual([...telemetry.columns.get('a')![1]], [NaN, 5, NaN, 0]);
});

test('telemetry of another length than its head says is damaged', () => {
  const head = { rows: 2, ticks: { first: 0, every: 1 }, columns: [{ name: 'a', index: 0, unit: 'm', scale: 1 }] };
  assert.throws(() => telemetryOf(head, new Uint8Array(3)), /3 bytes, 4 belong/);
});

test('the last entry at or before a tick is found, none before the first', () => {
  const list = [{ tick: 10 }, { tick: 20 }, { tick: 20 }, { tick: 30 }];
  assert.deepEqual([5, 10, 25, 20, 99].map((tick) => lastBefore(list, tick)), [-1, 0, 2, 2, 3]);
});

test('decimation keeps every peak and stays under the most points', () => {
  const values = Array.from({ length: 1000 }, (_, i) => (i === 637 ? 50 : i === 201 ? -50 : Math.sin(i / 50)));
  const [times, curve] = decimated((row) => row, [values], 0, 999, 100);
  assert.ok(times.length <= 100);
  assert.equal(Math.max(...curve), 50);
  assert.equal(Math.min(...curve), -50);
  assert.ok(times.every((t, i) => i === 0 || t > times[i - 1]));
});

test('where there are fewer rows than points all of them are kept', () => {
  const [times, curve] = decimated((row) => row / 10, [[1, 2, NaN]], 0, 2, 100);
  assert.deepEqual([...curve], [1, 1, 2, 2, NaN, NaN]);
  assert.equal(times[2], 0.1);
});

test('of a run each moment has the facts of its time, which are told by their changes, and the tip of its angles', () => {
  const names = Array.from({ length: 10 }, (_, index) => ({ name: 'measured_js_deg', index, unit: 'deg', scale: 0.001 }));
  const facts = [{ tick: 10, state: { state: 'DISABLED', owner: 'anna' } }, { tick: 15, state: { state: 'ENABLED' } }];
  const telemetry = { rows: 2, ticks: { first: 10, every: 5 }, columns: names };
  const head: RunHead = { format: 1, title: '', robot: ARM, scene: { name: 's' }, report: null, period_s: 0.004, steps: [], events: [], commands: [], facts, telemetry };
  const angles_mdeg = [-8500, 0, -12000, 0, 8000, -2000, 13000, 0, 12000, -2000];
  const run = new Run(head, planesOf(angles_mdeg.map((a) => [0, a])));
  assert.deepEqual(run.at(0).facts, { state: 'DISABLED', owner: 'anna' });
  const sample = run.at(1);
  assert.deepEqual([sample.tick, sample.facts], [15, { state: 'ENABLED', owner: 'anna' }]);
  const chain = chainOf(ARM);
  chain.set(angles_mdeg.map((a) => a / 1000));
  for (let r = 0; r < 3; ++r) assert.ok(near(sample.numbers.get('measured_cp')![r], chain.tip[12 + r], 1e-5));
});

test('the checksum is that of IEEE 802.3', () => {
  assert.equal(crc32(new TextEncoder().encode('123456789')), 0xcbf43926); // its check value
  assert.equal(crc32(new Uint8Array()), 0);
});

test('no two cables of a strip look the same, and its limits are those of robot and scene', () => {
  const groups = groupsOf(ARM, { name: 'x', margins: { slow_m: 0.006, refuse_m: 0.003 } }, () => true);
  const limits = (name: string) => groups.find((group) => group.name === name)?.limits?.map(({ at }) => at);
  const tension = groups.find(({ name }) => name === 'tension')!;
  assert.equal(new Set(tension.sources.map(({ colour, dash }) => `${colour} ${dash}`)).size, 15);
  assert.equal(new Set(tension.sources.map(({ label }) => label)).size, 15);
  assert.deepEqual(limits('tension'), [15, 150, 400]);
  assert.deepEqual(limits('pitch'), [20, -20]);
  assert.deepEqual(limits('clearance'), [6, 3]);
});

test('a limit near the values is in the strip, and one far away leaves them their height', () => {
  const limits = [{ at: 15, name: 'floor' }, { at: 150, name: 'ceiling' }];
  const [bottom, top] = yRange(35, 60, Infinity, limits);
  assert.ok(bottom < 15 && bottom > 0 && top > 60 && top < 100);
  assert.ok(yRange(100, 140, Infinity, limits)[1] > 150);
  assert.deepEqual(yRange(null, null, Infinity, limits), [0, 1]);
});
