# shellcheck shell=bash
# Wine, for scripts that run programs for Windows: export WINEPREFIX, a folder, and `source scripts/wine.sh`.
export WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml='  # no window asks for Mono

# The server of Wine stays until stop_wine, because a program that starts while the server shuts down would fail.
start_wine() { mkdir -p "$WINEPREFIX" && wineserver -p && wine wineboot --init; }
stop_wine() { wineserver -k 2>/dev/null || true; }
