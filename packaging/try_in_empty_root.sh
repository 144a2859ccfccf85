#!/bin/sh
# Tries the self-contained folder on a Debian that has no Python, in a root of its own; needs root and
# debootstrap:  packaging/try_in_empty_root.sh build/frozen/skinsource [ROOT]
set -eu
folder=$1 root=${2:-build/empty-root}
# Every desktop has these: a screen, OpenGL, fonts.
wanted=xvfb,xauth,x11-utils,libegl1,libgl1,libfontconfig1,libdbus-1-3,fonts-dejavu-core
[ -d "$root/usr/bin" ] || debootstrap --variant=minbase --include=$wanted bookworm "$root"
rm -rf "$root/studio" && cp -r "$folder" "$root/studio"
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
mountpoint -q "$root/dev/shm" || { mkdir -p "$root/dev/shm" && mount -t tmpfs tmpfs "$root/dev/shm"; }
trap 'umount "$root/proc" "$root/dev/shm"' EXIT
cat >"$root/try.sh" <<'TRY'
set -eu
HOME=$(mktemp -d) PATH=/studio:/usr/bin:/bin
export HOME PATH
cd "$HOME"
! command -v python3 python
skinsource doctor
skinsource scenes 2F --out scene.skinsource
skinsource export scene.skinsource --format wav --rate 48000 --out drive.wav
printf 'designs = ["scene.skinsource"]\n[vary]\namplitude = [1, 2]\n' >sweep.toml
skinsource sweep sweep.toml --out swept && cat swept/stimuli.csv
skinsource-process -c 'from pathlib import Path
from skinsource.readers.reading_process import ReadingProcess
with ReadingProcess() as process:
    print("read in another process:", process.look(Path("drive.wav")))'
Xvfb :9 -screen 0 1600x1000x24 >/dev/null 2>&1 &
screen=$!
export DISPLAY=:9
begun=$(date +%s%N)
skinsource-gui scene.skinsource &
studio=$!
until xwininfo -root -tree 2>/dev/null | grep -q '"skinsource-gui" "SkinSource studio"'; do kill -0 $studio; done
echo "The window stands after $((($(date +%s%N) - begun) / 1000000)) ms."
kill $studio $screen
TRY
env -i PATH="$PATH" chroot "$root" /bin/sh /try.sh
