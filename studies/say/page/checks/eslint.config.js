// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
import js from '@eslint/js';
import globals from 'globals';

const more = {eqeqeq: ['error', 'always', {null: 'ignore'}], 'max-len': ['error', {code: 120}], 'no-var': 'error', 'prefer-const': 'error'};

export default [
  js.configs.recommended,
  {files: ['web/**/*.js'], languageOptions: {globals: {...globals.browser, Plotly: 'readonly'}}, rules: more},
  {files: ['sessions/**/*.mjs'], languageOptions: {globals: {...globals.node, ...globals.browser}}, rules: more},
];
