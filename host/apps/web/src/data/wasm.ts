// Programs of ours as WebAssembly: the core, and what is around it.

// The exports of a program that is ready to be called. It asks its surroundings for nothing that matters: no file, no
// clock.
export async function startedProgram(program: Uint8Array): Promise<WebAssembly.Exports> {
  const module = await WebAssembly.compile(program as BufferSource);
  const nothing = Object.fromEntries(WebAssembly.Module.imports(module).map(({ name }) => [name, () => 0]));
  const { exports } = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: nothing });
  (exports['_initialize'] as () => void)();
  return exports;
}
