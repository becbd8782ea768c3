// npm's canopen as the master of one drive of the bench: boot, SDO, CiA 402, motion by PDO. It knows the drive by its data
// sheet alone, the file that is its argument: every object goes by its name there.
import { DataType, Device, Eds, NmtState, connect, live, pass, send } from './node_end.mjs';

const NODE = 3;
const TIMEOUT_MS = 200;

const device = new Device({ id: 127 });
connect(device);
device.eds.addSdoClientParameter(NODE, 0x600 + NODE, 0x580 + NODE);

const sheet = Eds.fromFile(process.argv[2]);

// An object of the sheet by its name, or one of its entries by the entry's.
function object(name, entryName) {
  const all = sheet.findEntry(name);
  if (all.length !== 1) throw new Error(`${name}: ${all.length} of that name in the data sheet`);
  if (entryName === undefined) return all[0];
  const found = entries(all[0]).filter((entry) => entry.parameterName === entryName);
  if (found.length !== 1) throw new Error(`${name}, ${entryName}: ${found.length} of that name in the data sheet`);
  return found[0];
}

function entries(whole) {
  if (whole.subNumber === undefined) return [whole];
  return Array.from({ length: 256 }, (_, i) => whole[i]).filter((entry) => entry !== undefined);
}

const place = ({ index, subIndex, dataType }) => ({ deviceId: NODE, index, subIndex: subIndex ?? 0, dataType });
const ask = (entry) => device.sdo.upload({ ...place(entry), timeout: TIMEOUT_MS });
const read = (...names) => ask(object(...names));
const write = (data, ...names) => device.sdo.download({ ...place(object(...names)), data, timeout: TIMEOUT_MS });
const mapped = ({ index, subIndex, raw }) => ((index << 16) | ((subIndex ?? 0) << 8) | (8 * raw.length)) >>> 0;

// What it tells by PDO and is told: objects of this device, mapped as the drive's are.
const entry = (index, dataType, name) => device.eds.addEntry(index, { parameterName: name, dataType });
const controlword = entry(0x2000, DataType.UNSIGNED16, 'controlword');
const target = entry(0x2001, DataType.INTEGER32, 'target');
const statusword = entry(0x2002, DataType.UNSIGNED16, 'statusword');
const position = entry(0x2003, DataType.INTEGER32, 'position');
const torque = entry(0x2004, DataType.INTEGER16, 'torque');
device.eds.addTransmitPdo({ cobId: 0x200 + NODE, transmissionType: 254, dataObjects: [controlword, target] });
device.eds.addReceivePdo({ cobId: 0x180 + NODE, transmissionType: 1, dataObjects: [statusword, position, torque] });

async function map(pdo, cobId, names) {
  const communication = `${pdo} communication parameter`;
  const mapping = `${pdo} mapping parameter`;
  const cob = `COB-ID used by ${pdo.slice(0, 4)}`;
  await write((0x80000000 + cobId) >>> 0, communication, cob);
  await write(0, mapping, 'Number of mapped objects');
  for (const [i, name] of names.entries()) await write(mapped(object(name)), mapping, `Mapped object ${i + 1}`);
  await write(names.length, mapping, 'Number of mapped objects');
  await write(1, communication, 'Transmission type');
  await write(cobId, communication, cob);
}

// Objects of the sheet that the drive has otherwise: not at all, longer or shorter, or with another value than the sheet
// promises, where the sheet can know it.
async function otherwise() {
  const differ = [];
  let compared = 0;
  for (const whole of sheet.values())
    for (const entry of entries(whole)) {
      const said = await ask(entry).catch((error) => error.message);
      const promised = entry.defaultValue;
      const isKnown = promised !== undefined && !String(promised).startsWith('$NODEID') && !BY_ROBOT.has(whole.index);
      const expected = entry.dataType === DataType.VISIBLE_STRING ? promised : Number(promised);
      compared += isKnown ? 1 : 0;
      if (isKnown ? said !== expected : typeof said !== 'number') differ.push([entry.key, said, expected]);
    }
  return { differ, compared };
}
// The robot's table decides some; some say where the motor is and how the boot has gone.
const BY_ROBOT = new Set([0x1018, 0x608f, 0x6076, 0x6085, 0x6091, 0x6062, 0x6064, 0x6077, 0x6078, 0x607a, 0x6041, 0x60f4]);

async function lead(command, mask, value) {
  controlword.value = command;
  for (let i = 0; i < 100; ++i) {
    if ((statusword.value & mask) === value) return;
    await pass(2);
  }
  throw new Error(`controlword ${command}: the statusword stays 0x${statusword.value.toString(16)}`);
}

let cyclic = false;

async function story() {
  const found = {};
  device.start();
  device.nmt.setState(NmtState.OPERATIONAL);
  device.nmt.resetNode(NODE);
  await pass(10);
  Object.assign(found, await otherwise());
  found.profile = await read('Device type');
  found.name = await read('Manufacturer device name');
  found.serial = await read('Identity object', 'Serial number');
  found.refused = await ask({ index: 0x5fff, dataType: DataType.UNSIGNED32 }).then(
    () => 'nothing',
    (error) => error.message,
  );
  await map('RPDO1', 0x200 + NODE, ['Controlword', 'Target position']);
  await map('TPDO1', 0x180 + NODE, ['Statusword', 'Position actual value', 'Torque actual value']);
  await write(8, 'Modes of operation');
  await write(100, 'Producer heartbeat time');
  device.nmt.startNode(NODE);
  const from = await read('Position actual value');
  target.value = from;
  cyclic = true;
  await lead(0x06, 0x6f, 0x21);
  await lead(0x07, 0x6f, 0x23);
  await lead(0x0f, 0x6f, 0x27);
  for (let i = 1; i <= 200; ++i) {
    target.value = from + 10 * i;
    await pass(2);
  }
  await pass(200);
  found.moved = position.value - from;
  controlword.value = 0;
  await pass(10);
  found.off = statusword.value & 0x4f;
  return found;
}

// SYNC at the start of a slot, the command in its middle, as docs/reference/drives.md has it.
live([device], story, (wake) => {
  if (wake.starts) send(0, 0x080);
  if (!wake.starts && cyclic) device.pdo.write(0x200 + NODE);
});
