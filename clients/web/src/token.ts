// The bearer token of this tab. It comes in the part of the address behind `#`, which browsers do not send to servers.

const KEY = "sinew-token";

/** Takes `token=…` out of the address, so that it is neither seen, copied nor kept in the history. */
export function takeToken(): string {
  const parts = new URLSearchParams(location.hash.replace(/^#/, ""));
  const given = parts.get("token");
  if (given !== null) {
    parts.delete("token");
    const rest = parts.toString();
    history.replaceState(null, "", rest ? `#${rest}` : location.pathname + location.search);
    sessionStorage.setItem(KEY, given);
  }
  return sessionStorage.getItem(KEY) ?? "";
}
