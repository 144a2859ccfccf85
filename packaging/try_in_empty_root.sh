-c "$(cat help.py)"#!/bin/sh
# Tries the self-contained folder on a Debian that has no Python, in a root of its own; needs root and
# debootstrap:  packaging/try_in_empty_root.sh build/frozen/skinsource [ROOT]
set -eu
folder=$1 root=${2:-build/empty-root}
# Every desktop has these: a screen, OpenGL, fonts, ALSA.
wanted=xvfb,xauth,x11-utils,libegl1,libgl1,libfontconfig1,libdbus-1-3,fonts-dejavu-core,libasound2
[ -d "$root/usr/bin" ] || debootstrap --variant=minbase --include=$wanted bookworm "$root"
rm -rf "$root/studio" && cp -r "$folder" "$root/studio"
mountpoint -q "$root/proc" || mount -t proc proc "$root/proc"
mountpoint -q "$root/dev/shm" || { mkdir -p "$root/dev/shm" && mount -t tmpfs tmpfs "$root/dev/shm"; }
trap 'umount "$root/proc" "$root/dev/shm"' EXIT
cat >"$root/try.sh" <<'TRY'
set -eu
HOME=$(mktemp -d)
PATH=/studio:$HOME:/usr/bin:/bin
export HOME PATH
cd "$HOME"
! command -v python3 python
skinsource doctor
skinsource scenes 2F --out scene.skinsource
skinsource export scene.skinsource --format wav --rate 48000 --out drive.wav
skinsource film scene.skinsource --out wave.mp4
ls -l wave.mp4
skinsource share scene.skinsource --out page.html
printf 'designs = ["scene.skinsource"]\n[vary]\namplitude = [1, 2]\n' >sweep.toml
skinsource sweep sweep.toml --out swept
cat swept/stimuli.csv
ls /studio/docs/index.html /studio/examples
cat >try.py <<'PYTHON'
from pathlib import Path
import pylsl, sounddevice
print("LSL", pylsl.library_version(), sounddevice.get_portaudio_version()[1])
from skinsource.readers.reading_process import ReadingProcess
with ReadingProcess() as process:
    print("read in another process:", process.look(Path("drive.wav")))
PYTHON
skinsource-process -c "$(cat try.py)"
Xvfb :9 -screen 0 1600x1000x24 >/dev/null 2>&1 &
screen=$!
trap 'kill $screen' EXIT
export DISPLAY=:9
until xwininfo -root >/dev/null 2>&1; do kill -0 $screen; done
begun=$(date +%s%N)
skinsource-gui scene.skinsource &
studio=$!
until xwininfo -root -tree 2>/dev/null | grep -q '"skinsource-gui" "SkinSource studio"'; do kill -0 $studio; done
echo "The window stands after $((($(date +%s%N) - begun) / 1000000)) ms."
kill $studio
# A browser of this machine is asked for the manual, without the libraries of the folder.
printf '#!/bin/sh\necho "$1" "libraries: $LD_LIBRARY_PATH" >"%s/opened"\n' "$HOME" >xdg-open
chmod +x xdg-open
cat >help.py <<'PYTHON'
import os
from skinsource_gui.app.app import make_application, make_window
from skinsource_gui.state.preferences import Preferences, settings_path
application = make_application()
window = make_window(None, Preferences(settings_path()))
window.show()
window.do("show_manual")
os._exit(0)
PYTHON
skinsource-process -c "$(cat help.py)" || true
cat opened
TRY
env -i PATH="$PATH" chroot "$root" /bin/sh /try.sh
