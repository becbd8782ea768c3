// The little of node that the tests use; its own types would be two packages more.
declare module 'node:assert/strict' {
  interface Assert {
    ok(value: unknown, message?: string): void;
    equal(actual: unknown, expected: unknown, message?: string): void;
    notEqual(actual: unknown, expected: unknown, message?: string): void;
    deepEqual(actual: unknown, expected: unknown, message?: string): void;
    match(text: string, pattern: RegExp, message?: string): void;
    throws(call: () => unknown, pattern?: RegExp): void;
  }
  const assert: Assert;
  export default assert;
}
declare module 'node:test' {
  export function test(sentence: string, body: () => void | Promise<void>): void;
}
declare module 'node:crypto' {
  export const webcrypto: Crypto;
}
declare module 'node:fs' {
  export function readFileSync(path: string, encoding: 'utf8'): string;
}
declare module 'node:path' {
  export function join(...parts: string[]): string;
}
declare const process: { env: Record<string, string | undefined>; cwd(): string };

declare module 'node:child_process' {
  export function spawnSync(
    program: string,
    words: string[],
    options: { input: string; encoding: 'utf8' },
  ): { stdout: string; stderr: string; status: number | null; error?: Error };
}
