#!/usr/bin/env bash
# Lint, lay out and type-check the JavaScript of dondolo serve and of the site: bash test/page/check.sh [--format]
# With --format it is laid out anew first. Needs npm, which takes the linters in the versions of package-lock.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. packaging/steps.sh

here=test/page
if [ ! "$here/node_modules/.package-lock.json" -nt "$here/package-lock.json" ]; then
   step "installing Biome and TypeScript by npm" npm ci --prefix "$here" --ignore-scripts --no-audit --no-fund || {
      # Where npm always is nothing is left out in silence.
      [ -z "${GITHUB_ACTIONS:-}" ] || exit 1
      say "./run page: skipped, since npm cannot install the linters here"
      exit 0
   }
fi
PATH=$PWD/$here/node_modules/.bin:$PATH
sources=(python/dondolo/serve/page docs/site/static)
if [ "${1:-}" = --format ]; then biome format --write --config-path="$here/lint.json" "${sources[@]}"; fi
biome ci --config-path="$here/lint.json" --error-on-warnings "${sources[@]}"
tsc --project "$here"
say "./run page: laid out, linted and type-checked"
