// How often something happens: over the last second.

export class Rate {
  private times_s: number[] = [];

  // `count` things happened at `now_s`.
  add(now_s: number, count = 1): void {
    for (let i = 0; i < count; ++i) this.times_s.push(now_s);
    while (this.times_s.length > 0 && this.times_s[0] < now_s - 1) this.times_s.shift();
  }

  perSecond(now_s: number): number {
    return this.times_s.filter((t) => t > now_s - 1).length;
  }
}
