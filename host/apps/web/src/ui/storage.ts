// What this browser keeps for the page. Without storage (switched off, or file://) it lasts as long as the page.

export function keep(key: string, text: string): void {
  try {
    localStorage.setItem(key, text);
  } catch {
    // for this time only, then
  }
}

export function kept(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}
