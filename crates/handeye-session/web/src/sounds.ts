// Three short sounds, for whoever looks at the robot and not at the screen: taken, refused, accurate enough.

const SOUNDS = {
  taken: [[660, 0, 0.09], [990, 0.08, 0.14]],
  refused: [[220, 0, 0.16], [175, 0.17, 0.26]],
  enough: [[523, 0, 0.14], [659, 0.12, 0.14], [784, 0.24, 0.14], [1047, 0.36, 0.35]],
} as const satisfies Record<string, readonly (readonly [hertz: number, start: number, seconds: number])[]>;

export type Sound = keyof typeof SOUNDS;

let context: AudioContext | null = null;

/** Browsers allow sounds only after someone has touched the page. */
export function wakeSounds(): void {
  context ??= typeof AudioContext === "undefined" ? null : new AudioContext();
  void context?.resume();
}

export function play(sound: Sound): void {
  if (!context || context.state !== "running") return;
  for (const [hertz, start, seconds] of SOUNDS[sound]) {
    const at = context.currentTime + start;
    const tone = context.createOscillator();
    const volume = context.createGain();
    tone.type = sound === "refused" ? "triangle" : "sine";
    tone.frequency.value = hertz;
    volume.gain.setValueAtTime(0, at);
    volume.gain.linearRampToValueAtTime(0.25, at + 0.01);
    volume.gain.exponentialRampToValueAtTime(0.001, at + seconds);
    tone.connect(volume).connect(context.destination);
    tone.start(at);
    tone.stop(at + seconds + 0.02);
  }
}
