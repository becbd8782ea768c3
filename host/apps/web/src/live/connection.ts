// The WebSocket to the gateway: hello, requests with their answers, records with their credits, and again after it died.
import { creditOf, SUBPROTOCOL, proofOf, type Answer, type FromGateway, type Token, type Welcome } from './protocol';

export interface Listener {
  name(): string; // who we are, where no token says it
  token(): Token | null; // null: none is known
  wantsToken(why: string): void; // the person has to say one; then Connection.open() again
  status(text: string): void; // empty: all is well
  welcome(message: Welcome): void;
  message(message: FromGateway): void;
  record(bytes: ArrayBuffer): number | null; // its sequence, null when it is no record of the layout
}

const FIRST_RETRY_MS = 500;
const LAST_RETRY_MS = 5000;
const ANSWER_MS = 5000;
const GREETING_MS = 10000; // from the attempt to the gateway's first message: one that hangs is given up
const GONE = 'no connection to the gateway: an arm that was steered from here holds; trying again';
const POLICY_VIOLATED = 1008;
const ANSWERED_TOGETHER = 2; // records: each answer wakes the gateway

type Waiting = { answered: (answer: Answer) => void; timer: number };

export class Connection {
  private socket: WebSocket | null = null;
  private retry_ms = FIRST_RETRY_MS;
  private nextId = 1;
  private unanswered = 0; // records
  private readonly waiting = new Map<number, Waiting>();
  private isWelcome = false;
  private askedForToken = false;

  constructor(private readonly url: string, private readonly listener: Listener) {}

  open(): void {
    this.askedForToken = false;
    this.listener.status('connecting to the gateway');
    const socket = new WebSocket(this.url, SUBPROTOCOL);
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    const patience = window.setTimeout(() => socket.close(), GREETING_MS);
    socket.onmessage = (event: MessageEvent) => {
      window.clearTimeout(patience);
      if (typeof event.data === 'string') void this.take(JSON.parse(event.data) as FromGateway);
      else this.takeRecord(event.data as ArrayBuffer);
    };
    socket.onclose = (event) => {
      window.clearTimeout(patience);
      this.closed(event);
    };
  }

  // Says hello anew, under another name.
  again(): void {
    this.retry_ms = 0;
    this.socket?.close();
  }

  // Asks lianad; errors are answers, too, also that nothing came back.
  request(request: object): Promise<Answer> {
    return this.send('request', { request });
  }

  // Emergency stop: for every role, and sent at once whatever else is under way.
  stop(reason: string): Promise<Answer> {
    return this.send('stop', { reason });
  }

  // Sends without waiting for the answer: streams of setpoints and device samples. An error goes to `failed`.
  tell(request: object, failed: (answer: Answer) => void): void {
    void this.request(request).then((answer) => {
      if (!answer.ok) failed(answer);
    });
  }

  // Sends what comes again so soon that nobody waits for an answer: samples of a device. An error comes as a message.
  post(request: object): void {
    if (this.socket?.readyState === WebSocket.OPEN && this.isWelcome) this.socket.send(JSON.stringify({ op: 'request', request }));
  }

  private send(op: string, what: object): Promise<Answer> {
    const { socket } = this;
    if (!socket || socket.readyState !== WebSocket.OPEN || !this.isWelcome)
      return Promise.resolve({ op: 'answer', ok: false, code: 'not_connected', message: 'no connection to the gateway: use the emergency stop at the arm' });
    const id = this.nextId++;
    return new Promise((answered) => {
      const late: Answer = { op: 'answer', id, ok: false, code: 'no_answer', message: `no answer within ${ANSWER_MS / 1000} s` };
      this.waiting.set(id, { answered, timer: window.setTimeout(() => this.answer(late), ANSWER_MS) });
      socket.send(JSON.stringify({ op, id, ...what }));
    });
  }

  private answer(answer: Answer): void {
    const waiting = this.waiting.get(answer.id ?? -1);
    if (!waiting) return;
    window.clearTimeout(waiting.timer);
    this.waiting.delete(answer.id!);
    waiting.answered(answer);
  }

  private async take(message: FromGateway): Promise<void> {
    if (message.op === 'challenge') return this.hello(message.nonce, message.proof ?? !message.loopback);
    if (message.op === 'answer' && message.id !== undefined) return this.answer(message);
    if (message.op === 'away') this.listener.status(message.text);
    if (message.op === 'welcome') {
      this.isWelcome = true;
      this.retry_ms = FIRST_RETRY_MS;
      this.listener.status('');
      this.listener.welcome(message);
    }
    this.listener.message(message);
  }

  private async hello(nonce: string, needsProof: boolean): Promise<void> {
    if (!needsProof) return this.socket?.send(JSON.stringify({ op: 'hello', name: this.listener.name() }));
    const token = this.listener.token();
    if (!token) return this.askForToken('This gateway asks who you are.');
    const { socket } = this;
    const proof = await proofOf(token.secret, nonce);
    if (socket !== this.socket) return; // another connection has another nonce
    socket?.send(JSON.stringify({ op: 'hello', token_name: token.name, proof }));
  }

  private askForToken(why: string): void {
    this.askedForToken = true;
    this.listener.wantsToken(why);
    this.socket?.close();
  }

  private takeRecord(bytes: ArrayBuffer): void {
    const sequence = this.listener.record(bytes);
    if (sequence === null || ++this.unanswered < ANSWERED_TOGETHER) return;
    this.unanswered = 0;
    this.socket?.send(creditOf(sequence));
  }

  private closed(event: CloseEvent): void {
    const wasWelcome = this.isWelcome;
    this.isWelcome = false;
    for (const id of [...this.waiting.keys()]) {
      this.answer({ op: 'answer', id, ok: false, code: 'not_connected', message: 'the connection to the gateway broke before the answer' });
    }
    if (this.askedForToken) return;
    if (event.code === POLICY_VIOLATED && !wasWelcome && this.listener.token()) return this.askForToken(event.reason || 'The gateway refused this token.');
    this.listener.status(event.reason ? `the gateway closed the connection: ${event.reason}` : GONE);
    window.setTimeout(() => this.open(), this.retry_ms);
    this.retry_ms = Math.min(LAST_RETRY_MS, Math.max(FIRST_RETRY_MS, 2 * this.retry_ms));
  }
}
