// What was measured in the pictures of the captures: the corners of all, and the residuals of the one that is looked at. The
// corners stay, the residuals change with every assessment.

import { getJson } from "./link";
import type { Capture, CaptureDetail, State } from "./state";

const AGAIN = 2000; // ms until what did not come is asked for again

interface Kept {
  time: Capture["time_s"]; // one that was retaken is another one
  assessed: State["assessed"];
  detail: CaptureDetail | null;
  asking: boolean;
}

/** Keeps the details of captures, and says when new ones have come. */
export function detailStore(arrived: () => void) {
  const kept = new Map<string, Kept>();

  async function ask(id: string, entry: Kept, assessed: State["assessed"]): Promise<void> {
    entry.asking = true;
    try {
      entry.detail = await getJson<CaptureDetail>(`/api/captures/${encodeURIComponent(id)}.json`);
      entry.assessed = assessed;
      arrived();
    } catch {
      await new Promise((done) => setTimeout(done, AGAIN));
    }
    entry.asking = false;
  }

  return {
    /** Asks for what is missing, one capture after the other, that of `selected` first. */
    update(state: State, selected: string | null): void {
      // a capture is known there once it was assessed
      const known = (state.captures ?? []).filter(({ corners }) => corners);
      for (const id of kept.keys()) if (!known.some((capture) => capture.id === id)) kept.delete(id);
      if ([...kept.values()].some(({ asking }) => asking)) return;
      for (const { id, time_s: time } of [...known].sort((a, b) => Number(b.id === selected) - Number(a.id === selected))) {
        let entry = kept.get(id);
        if (entry?.time !== time) entry = undefined;
        if (!entry) kept.set(id, (entry = { time, assessed: undefined, detail: null, asking: false }));
        const isOld = id === selected && entry.assessed !== state.assessed;
        if (entry.detail && !isOld) continue;
        void ask(id, entry, state.assessed);
        return;
      }
    },
    of: (id: string): CaptureDetail | null => kept.get(id)?.detail ?? null,
  };
}
