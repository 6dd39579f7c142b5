// The way to the server: the state by long polling, commands, and whether the server can be reached.

import type { Command, Problem, State } from "./state";

const FIRST_PAUSE = 300; // ms until the next try after the connection was lost, then twice as long each time
const LONGEST_PAUSE = 3000;
const PATIENCE = 30_000; // ms; the server answers after 20 s at the latest

/** An answer that is not 200. */
export class Refusal extends Error {
  constructor(
    readonly status: number,
    readonly problem: Problem,
  ) {
    super(problem.message);
  }
}

export const pause = (ms: number) => new Promise<void>((done) => setTimeout(done, ms));

async function refusal(answer: Response): Promise<Refusal> {
  const said = (await answer.json().catch(() => null)) as { error?: Problem } | null;
  return new Refusal(answer.status, said?.error ?? { message: `${answer.status} ${answer.statusText}`, advice: null });
}

export async function getJson<T>(address: string): Promise<T> {
  const answer = await fetch(address, { signal: AbortSignal.timeout(PATIENCE) });
  if (!answer.ok) throw await refusal(answer);
  return (await answer.json()) as T;
}

export async function getText(address: string): Promise<string> {
  const answer = await fetch(address, { signal: AbortSignal.timeout(PATIENCE) });
  if (!answer.ok) throw await refusal(answer);
  return answer.text();
}

/** Sends a command; throws a `Refusal` where it is refused. */
export async function command(wanted: Command): Promise<void> {
  const answer = await fetch("/api/do", {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(wanted),
    signal: AbortSignal.timeout(PATIENCE),
  });
  if (!answer.ok) throw await refusal(answer);
}

/** Hands over an image's file; throws a `Refusal` where it is refused. */
export async function sendImage(image: Blob): Promise<void> {
  const answer = await fetch("/api/image", { method: "POST", body: image, signal: AbortSignal.timeout(PATIENCE) });
  if (!answer.ok) throw await refusal(answer);
}

/** Hands every new state on, for ever. `lost` gets the reason while there is no connection, null when it is there again. */
export async function follow(arrived: (state: State) => void, lost: (why: unknown) => void): Promise<never> {
  let version: number | null = null;
  let wait = FIRST_PAUSE;
  for (;;) {
    try {
      const state: State = await getJson(version === null ? "/api/state" : `/api/state?after=${version}`);
      if (wait !== FIRST_PAUSE) lost(null);
      wait = FIRST_PAUSE;
      version = state.version;
      arrived(state);
    } catch (why) {
      lost(why);
      version = null; // a server that was started again counts from the beginning
      await pause(wait);
      wait = Math.min(2 * wait, LONGEST_PAUSE);
    }
  }
}
