#!/bin/sh
# SPDX-License-Identifier: MIT
# Usage: install-packages.sh PACKAGE...
# Installs those of the Debian packages that are missing. Without permission to install packages it says what to
# install, and ends with exit code 2.
set -eu

if ! command -v dpkg-query >/dev/null; then
  echo "This is not Debian or Ubuntu; the contents of these packages must be installed: $*" >&2
  exit 0
fi

missing=""
for package in "$@"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
  as_root="sudo"
else
  echo "These packages are missing, and installing them requires root:$missing" >&2
  echo "Ask someone with root access to run:" >&2
  echo "  apt-get update && apt-get install --no-install-recommends$missing" >&2
  exit 2
fi

echo "Installing:$missing"
$as_root apt-get update -q || echo "apt-get update failed; continuing with the existing package lists" >&2
# shellcheck disable=SC2086
if ! $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing; then
  echo "apt-get could not install:$missing" >&2
  exit 2
fi
