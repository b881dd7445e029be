#!/usr/bin/env bash
# Builds the documentation into build/docs/site, without network once its packages are installed, and checks
# every link of it, and that public functions have their parameters documented. The API pages by Doxygen are at
# build/docs/site/api.
# usage: docs.sh [run]; run: also run every command of the walkthroughs, and renew their pictures. Needs the
# tools (tools/build.sh tools) and for run $PCL_UVOL_DATA, the folder of data sets.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${PCL_UVOL_BIN:-build/release/bin}
bash tools/install_dependencies.sh mkdocs mkdocs-material doxygen python3

if [ "${1:-}" = run ]; then
  python3 docs/site/run_commands.py "$bin" --renew docs/*.md docs/start/*.md docs/how/*.md docs/guide/*.md docs/howto/*.md
fi
rm -rf build/docs
mkdir -p build/docs/source/benchmarks/diary
cp -r docs/. build/docs/source
rm -r build/docs/source/site
python3 docs/site/make_reference.py "$bin" build/docs/source
# The repository keeps the measurements beside the benchmarks, the site below benchmarks/.
find build/docs/source -name '*.md' -exec sed -i 's#\.\./tests/benchmarks/README\.md#benchmarks/measurements.md#g
  s#\.\./tests/benchmarks/diary/#benchmarks/diary/#g' {} +
# Links of pages to sources and examples are no pages of the site: only their text stays.
find build/docs/source -name '*.md' -exec sed -Ei 's#\[([^]]*)\]\((\.\./)+(examples|include|src|tools)/[^)]*\)#\1#g' {} +
# Of their links, those to pages of docs/ stay. Others go to files that are not pages of the site: only their text stays.
sed -E 's#\]\(\.\./\.\./docs/#](@#g; s#\[([^]]*)\]\(\.\.?/[^)]*\)#\1#g; s#\]\(@#](../#g' tests/benchmarks/README.md \
  >build/docs/source/benchmarks/measurements.md
for page in tests/benchmarks/diary/*.md; do
  sed -E 's#\]\(\.\./README\.md#](@benchmarks/measurements.md#g; s#\]\(\.\./\.\./\.\./docs/#](@#g
    s#\[([^]]*)\]\(\.\.?/[^)]*\)#\1#g; s#\]\(@#](../../#g' "$page" >"build/docs/source/benchmarks/diary/$(basename "$page")"
done
sed -E 's#\]\(\.\./docs/#](@#g; s#\]\(\.\./examples/notebooks\)#](@notebooks/sph_star.md)#
  s#\[([^]]*)\]\(\.\.?/[^)]*\)#\1#g; s#\]\(@#](../#g' python/README.md \
  >build/docs/source/guide/python.md
mkdir build/docs/source/project
for name in changes:CHANGELOG contributing:CONTRIBUTING security:SECURITY; do
  sed -E 's#\]\(docs/#](@#g; s#\]\(tests/benchmarks/README\.md#](@benchmarks/measurements.md#g; s#\]\(SECURITY\.md#](project:security.md#g
    s#\[([^]]*)\]\([a-z.]+/[^)]*\)#\1#g; s#\]\(@#](../#g; s#\]\(project:#](#g' "${name#*:}.md" >"build/docs/source/project/${name%:*}.md"
done
python3 docs/site/render_notebooks.py examples/notebooks/*.ipynb build/docs/source/notebooks
mkdocs build --quiet --strict
doxygen docs/site/Doxyfile
python3 docs/site/check_api.py build/docs/doxygen_warnings.txt
python3 docs/site/check_links.py build/docs/site
echo "The documentation is build/docs/site/index.html."
