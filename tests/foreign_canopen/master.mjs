// npm's canopen as the master of one drive of the bench: boot, SDO, CiA 402, motion by PDO.
import { DataType, Device, NmtState, connect, live, pass, send } from './node_end.mjs';

const NODE = 3;
const TIMEOUT_MS = 200;

const device = new Device({ id: 127 });
connect(device);
device.eds.addSdoClientParameter(NODE, 0x600 + NODE, 0x580 + NODE);

const read = (index, subIndex, dataType) =>
  device.sdo.upload({ deviceId: NODE, index, subIndex, dataType, timeout: TIMEOUT_MS });
const write = (index, subIndex, dataType, data) =>
  device.sdo.download({ deviceId: NODE, index, subIndex, dataType, data, timeout: TIMEOUT_MS });

// What it tells by PDO and is told: objects of this device, mapped as the drive's are.
const entry = (index, dataType, name) => device.eds.addEntry(index, { parameterName: name, dataType });
const controlword = entry(0x2000, DataType.UNSIGNED16, 'controlword');
const target = entry(0x2001, DataType.INTEGER32, 'target');
const statusword = entry(0x2002, DataType.UNSIGNED16, 'statusword');
const position = entry(0x2003, DataType.INTEGER32, 'position');
const torque = entry(0x2004, DataType.INTEGER16, 'torque');
device.eds.addTransmitPdo({ cobId: 0x200 + NODE, transmissionType: 254, dataObjects: [controlword, target] });
device.eds.addReceivePdo({ cobId: 0x180 + NODE, transmissionType: 1, dataObjects: [statusword, position, torque] });

async function map(communication, cobId, entries) {
  const mapping = communication + 0x200;
  await write(communication, 1, DataType.UNSIGNED32, (0x80000000 + cobId) >>> 0);
  await write(mapping, 0, DataType.UNSIGNED8, 0);
  for (const [i, value] of entries.entries()) await write(mapping, i + 1, DataType.UNSIGNED32, value);
  await write(mapping, 0, DataType.UNSIGNED8, entries.length);
  await write(communication, 2, DataType.UNSIGNED8, 1);
  await write(communication, 1, DataType.UNSIGNED32, cobId);
}

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
  found.profile = await read(0x1000, 0, DataType.UNSIGNED32);
  found.name = await read(0x1008, 0, DataType.VISIBLE_STRING);
  found.serial = await read(0x1018, 4, DataType.UNSIGNED32);
  found.refused = await read(0x5FFF, 0, DataType.UNSIGNED32).then(
    () => 'nothing',
    (error) => error.message,
  );
  await map(0x1400, 0x200 + NODE, [0x60400010, 0x607a0020]);
  await map(0x1800, 0x180 + NODE, [0x60410010, 0x60640020, 0x60770010]);
  await write(0x6060, 0, DataType.INTEGER8, 8);
  await write(0x1017, 0, DataType.UNSIGNED16, 100);
  device.nmt.startNode(NODE);
  const from = await read(0x6064, 0, DataType.INTEGER32);
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

// SYNC at the start of a slot, the command in its middle, as docs/drives.md has it.
live([device], story, (wake) => {
  if (wake.starts) send(0, 0x080);
  if (!wake.starts && cyclic) device.pdo.write(0x200 + NODE);
});
