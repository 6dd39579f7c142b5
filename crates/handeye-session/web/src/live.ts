// The live picture: the newest few frames, so that the corners are drawn on the frame in which they were found.

import { pause } from "./link";

const KEPT = 3; // frames that wait for their corners; more would make the picture late

export interface Frame {
  number: number;
  image: ImageBitmap;
}

const frames: Frame[] = [];

/** The frame of this number where it is still here; else the newest. */
export function frameFor(wanted: number | undefined): Frame | null {
  const newest = frames[frames.length - 1];
  if (!newest) return null;
  return frames.find((frame) => frame.number === wanted) ?? newest;
}

/** Fetches frames for ever, and says so after each. Rests while nobody looks or `needed` is false. */
export async function watch(needed: () => boolean, arrived: () => void): Promise<never> {
  let last: string | null = null;
  for (;;) {
    if (document.hidden || !needed()) {
      await pause(200);
      continue;
    }
    try {
      const answer = await fetch(last === null ? "/api/live.jpg" : `/api/live.jpg?after=${last}`);
      if (answer.status === 200) {
        last = answer.headers.get("x-frame");
        keep({ number: Number(last), image: await createImageBitmap(await answer.blob()) });
        arrived();
        if (last === null) await pause(100);
      } else {
        last = null;
        await pause(answer.status === 204 ? 100 : 1000);
      }
    } catch {
      last = null;
      await pause(1000);
    }
  }
}

function keep(frame: Frame): void {
  frames.push(frame);
  while (frames.length > KEPT) frames.shift()?.image.close();
}
