# The Pythons of this machine, for other scripts: . packaging/find_python.sh

# find_python VERSION: the Python of a version, from PATH or from pyenv; nothing where there is none
find_python() {
   local python
   for python in "python$1" "${PYENV_ROOT:-$HOME/.pyenv}"/versions/"$1".*/bin/python; do
      if "$python" -c '' 2>/dev/null; then
         command -v "$python"
         return
      fi
   done
}
