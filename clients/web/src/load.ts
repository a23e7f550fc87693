// The load slider of one world: what all its figures carry.
import type { Session } from "./session.js";
import { kilograms } from "./words.js";

export class Load {
  private carrying: Promise<void> | undefined;
  private wanted: number | undefined;

  constructor(
    private readonly slider: HTMLInputElement,
    private readonly output: HTMLOutputElement,
    private readonly session: Session,
    private readonly on: { change: () => void; done: () => void; failed: (error: unknown) => void },
  ) {
    slider.addEventListener("input", () => this.changed());
  }

  /** What the slider says, kg. */
  get mass(): number {
    return this.slider.valueAsNumber;
  }

  /** Lets the slider act only while there are figures that can take a load. */
  enable(on: boolean): void {
    this.slider.disabled = !on;
  }

  /** Gives all figures this mass, kg. */
  set(mass: number): void {
    if (this.slider.disabled) return;
    this.slider.valueAsNumber = mass;
    this.changed();
  }

  private changed(): void {
    this.on.change();
    this.wanted = this.mass;
    this.show(this.wanted);
    this.carrying ??= this.carry().finally(() => (this.carrying = undefined));
  }

  private async carry(): Promise<void> {
    try {
      while (this.wanted !== undefined) {
        const mass = this.wanted;
        this.wanted = undefined;
        // A fallen figure stands up first, so that it can take the new load.
        const people = [...this.session.people.values()];
        for (const p of people) if (this.session.says(p, "FALLEN")) await this.session.standUp(p);
        await this.session.carry(people, mass);
        this.on.done();
      }
    } catch (error) {
      this.on.failed(error);
    }
  }

  private show(mass: number): void {
    this.output.textContent = kilograms(mass);
    this.slider.setAttribute("aria-valuetext", `${mass} kilograms in both hands of every figure`);
  }

  /** Takes over a load that another viewer set. */
  read(): void {
    if (this.carrying || document.activeElement === this.slider) return;
    const loads = [...this.session.people.values()].filter((p) => p.frame).map((p) => p.loadKg());
    if (!loads.length) return;
    const mass = Math.max(...loads);
    if (Math.abs(mass - this.mass) > 0.01 && mass <= 20) this.slider.value = String(mass);
    this.show(mass);
  }

  /** Waits for what is under way, and then shows no load. */
  async none(): Promise<void> {
    this.wanted = undefined;
    await this.carrying;
  }

  /** There is no load any more. */
  gone(): void {
    this.slider.value = "0";
    this.show(0);
  }
}
