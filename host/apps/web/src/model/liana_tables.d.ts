declare module 'liana:tables' {
  const tables: { faults: object[]; refusals: object[] };
  export default tables;
}
