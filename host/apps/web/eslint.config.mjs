// One style for all TypeScript and JavaScript of this project; `npm run lint` checks it, `node tests/page/run.mjs unit` too.
// Only names and traps: no rule here is about white space.
import tseslint from 'typescript-eslint';

// A physical quantity has its unit behind it, as in the wire protocol and in C++: tipSpeed_m_s.
const UNIT = '(_(s|ms|us|m|mm|m_s|mm_s|rad|rad_s|deg|deg_s|mdeg|kg|N|Hz|px|kB))?';
const as = (words) => ({ format: null, custom: { regex: `^(${words})$`, match: true } });
const CAMEL = `(?!k[A-Z])[a-z][a-zA-Z0-9]*${UNIT}`;
const SNAKE = '[a-z][a-zA-Z0-9_]*';
const UPPER = '[A-Z][A-Z0-9_]*';

const names = (typeProperty) => ['error',
  { selector: 'default', ...as(CAMEL) },
  { selector: ['parameter', 'variable'], ...as(`_|_?${CAMEL}`) },
  { selector: 'variable', modifiers: ['const', 'global'], ...as(`${CAMEL}|${UPPER}`) },
  { selector: ['variable', 'parameter'], modifiers: ['destructured'], format: null }, // has the name of its field
  { selector: 'variable', modifiers: ['const', 'global', 'destructured'], format: null },
  { selector: 'import', format: null },
  { selector: 'typeLike', format: ['PascalCase'] },
  { selector: 'typeProperty', ...as(typeProperty) },
  { selector: ['objectLiteralProperty', 'objectLiteralMethod'], format: null }, // requests, tables, options of others
];

export default tseslint.config(
  { ignores: ['build/**', '.cache/**', '**/node_modules/**'] },
  {
    files: ['**/*.{ts,mjs,js}'],
    plugins: { '@typescript-eslint': tseslint.plugin },
    languageOptions: { parser: tseslint.parser },
    linterOptions: { reportUnusedDisableDirectives: 'error' },
    rules: {
      '@typescript-eslint/naming-convention': names(CAMEL),
      '@typescript-eslint/no-unused-vars': ['error', { argsIgnorePattern: '^_', ignoreRestSiblings: true }],
      eqeqeq: 'error',
      'no-var': 'error',
      'prefer-const': 'error',
    },
  },
  {
    files: ['host/apps/web/**', 'tests/page/**'], // those in tsconfig.json
    languageOptions: { parserOptions: { project: './tsconfig.json', tsconfigRootDir: import.meta.dirname } },
    rules: { '@typescript-eslint/no-floating-promises': 'error', '@typescript-eslint/no-misused-promises': 'error' },
  },
  {
    // What lianad, the gateway and recordings send.
    files: ['**/data/{run,sample}.ts', '**/live/protocol.ts', '**/model/robot.ts', '**/kinematics_test.ts'],
    rules: { '@typescript-eslint/naming-convention': names(SNAKE) },
  },
);
