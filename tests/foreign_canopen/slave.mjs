// Drives by CiA 402 on npm's canopen, which does the communication: object dictionary, SDO, NMT, heartbeat, PDO. They
// stand where they are told, at each SYNC. argv[2]: JSON list of { id, counts_per_turn, ... }, one per drive.
import { AccessType, DataType, Device, NmtState, ObjectType, connect, live, send } from './node_end.mjs';

const DISABLED = 0x40;
const TRANSITIONS = [
  // statusword, controlword with its mask, the next statusword
  [DISABLED, 0x87, 0x06, 0x21],
  [0x21, 0x8f, 0x07, 0x23],
  [0x23, 0x8f, 0x0f, 0x27],
  [0x27, 0x8f, 0x07, 0x23],
  [0x23, 0x87, 0x06, 0x21],
  [0x27, 0x86, 0x02, DISABLED], // quick stop: it has no mass
  [0x23, 0x82, 0x00, DISABLED],
  [0x27, 0x82, 0x00, DISABLED],
  [0x21, 0x82, 0x00, DISABLED],
];

class Drive {
  constructor(settings) {
    this.device = new Device({ id: settings.id });
    const { eds } = this.device;
    const value = (index, dataType, defaultValue, accessType = AccessType.READ_WRITE) =>
      eds.addEntry(index, { parameterName: index.toString(16), dataType, defaultValue, accessType });
    const record = (index, ...members) => {
      if (eds.getEntry(index) === undefined)
        eds.addEntry(index, { parameterName: index.toString(16), objectType: ObjectType.RECORD });
      members.forEach(([dataType, defaultValue], i) => {
        if (dataType !== undefined)
          eds.addSubEntry(index, i + 1, { parameterName: `${i + 1}`, dataType, defaultValue });
      });
    };
    const { UNSIGNED8, UNSIGNED16, UNSIGNED32, INTEGER8, INTEGER16, INTEGER32 } = DataType;
    eds.getEntry(0x1000).value = 0x20192;
    eds.setIdentity({
      vendorId: settings.vendor,
      productCode: settings.product,
      revisionNumber: settings.revision,
      serialNumber: 1000 + settings.id,
    });
    for (const index of [0x1000, 0x1018]) saveDefaults(eds.getEntry(index));
    value(0x1005, UNSIGNED32, 0x80);
    value(0x1017, UNSIGNED16, 0);
    record(0x1016, [UNSIGNED32, 0]);
    eds.addSdoServerParameter(0, 0x580 + settings.id, 0x600 + settings.id);
    const mapping = Array(8).fill([UNSIGNED32, 0]);
    for (let i = 0; i < 4; ++i) {
      const off = i === 0 ? 0 : 0x80000000;
      const cobId = 0x100 * i + settings.id;
      const none = [undefined];
      record(0x1400 + i, [UNSIGNED32, (off + 0x200 + cobId) >>> 0], [UNSIGNED8, 1], none, none, [UNSIGNED16, 0]);
      record(0x1800 + i, [UNSIGNED32, (off + 0x180 + cobId) >>> 0], [UNSIGNED8, 1], none, none, [UNSIGNED16, 0]);
      record(0x1600 + i, ...mapping);
      record(0x1a00 + i, ...mapping);
      for (const index of [0x1600, 0x1a00]) eds.getEntry(index + i)[0].value = 0;
    }
    this.controlword = value(0x6040, UNSIGNED16, 0);
    this.statusword = value(0x6041, UNSIGNED16, DISABLED);
    value(0x605a, INTEGER16, 2);
    value(0x605e, INTEGER16, 2);
    value(0x6007, INTEGER16, 3);
    value(0x6060, INTEGER8, 0);
    this.position = value(0x6064, INTEGER32, settings.counts);
    value(0x6065, UNSIGNED32, 20000);
    value(0x6066, UNSIGNED16, 100);
    value(0x6072, UNSIGNED16, 1000);
    value(0x6076, UNSIGNED32, settings.rated_torque_mNm);
    value(0x6077, INTEGER16, 0);
    this.target = value(0x607a, INTEGER32, settings.counts);
    record(0x608f, [UNSIGNED32, settings.counts_per_turn], [UNSIGNED32, 1]);
    record(0x60c2, [UNSIGNED8, 4], [INTEGER8, -3]);
    value(0x6502, UNSIGNED32, 0x80);
    connect(this.device, settings.bus);
    this.state = DISABLED;
    this.least = this.most = settings.counts;
    this.nmt = NmtState.INITIALIZING;
    this.device.nmt.on('changeState', (state) => this.changed(state));
    this.device.start();
  }

  // The stack leaves the boot-up message (CiA 301, 7.2.8.3.3) to its user.
  changed(state) {
    const { id, bus } = this.device;
    if (this.nmt === NmtState.INITIALIZING && state === NmtState.PRE_OPERATIONAL) send(bus, 0x700 + id, 0);
    this.nmt = state;
  }

  sync() {
    if (this.device.state !== NmtState.OPERATIONAL) this.state = DISABLED;
    const command = this.controlword.value;
    for (const [from, mask, bits, to] of TRANSITIONS) {
      if (this.state !== from || (command & mask) !== bits) continue;
      this.state = to;
      break;
    }
    if (this.state === 0x27) this.position.value = this.target.value;
    this.statusword.value = this.state | 0x10 | (this.state === 0x27 ? 0x1000 : 0);
    this.least = Math.min(this.least, this.position.value);
    this.most = Math.max(this.most, this.position.value);
    this.states ??= new Set();
    this.states.add(this.state);
  }
}

function saveDefaults(entry) {
  for (const object of [entry, ...(entry.subObjects ?? [])]) if (object?.raw) object.defaultValue = object.value;
}

const drives = JSON.parse(process.argv[2]).map((settings) => new Drive(settings));
const seen = () =>
  drives.map((drive) => ({ states: [...(drive.states ?? [])], moved: drive.most - drive.least, ends: drive.state }));

live(
  drives.map((drive) => drive.device),
  () => new Promise(() => {}),
  () => {},
  { before: (frame) => frame.id === 0x80 && drives.forEach((drive) => drive.sync()), tell: seen },
);
